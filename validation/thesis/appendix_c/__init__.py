"""Appendix C: black box and both grey-box models against the responses (Figures 5 to 10)."""
