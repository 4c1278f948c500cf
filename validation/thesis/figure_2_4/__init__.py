"""Figures 2.4 and 2.5: a Bode plot of stepped sines, and the transfer function fitted to it."""
