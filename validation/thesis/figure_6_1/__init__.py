"""Table 6.1 and Figures 6.1 and 6.2: both loops in the frequency domain."""
