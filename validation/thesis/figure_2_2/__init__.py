"""Figures 2.2 and 2.3: a sine fitted to the response at low and at high frequency."""
