"""Thesis Table 4.1: 18 transfer functions fitted to the measured pump."""
