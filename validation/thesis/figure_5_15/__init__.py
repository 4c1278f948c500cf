"""Figures 5.15 and 5.16: heave of the vessel, and the pressures of ideal compensation."""
