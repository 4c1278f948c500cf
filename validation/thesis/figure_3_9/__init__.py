"""Figures 3.9 to 3.11: the pump's ripple flow."""
