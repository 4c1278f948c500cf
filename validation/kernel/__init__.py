"""Runs and their slopes against FMPy's CVODE: every model that runs by itself, and FMUs of other tools."""
