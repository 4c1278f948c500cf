"""Figures 4.6 and 4.7 and Table 4.9: both grey-box models over time, in a stochastic wave."""
