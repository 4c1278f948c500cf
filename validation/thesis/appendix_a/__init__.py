"""Appendix A: the wave spectrum, divided, and a wave of it (Figures 1 to 3)."""
