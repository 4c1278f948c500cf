"""Mean flow and ripple of the pump, thesis Section 3.4 and 4.1, from the geometry and from the FMU."""
