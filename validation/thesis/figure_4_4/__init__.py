"""Figures 4.4 and 4.5, and 2.6 and 2.7: one chirp against stepped sines."""
