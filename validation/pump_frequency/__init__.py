"""The pump's FMU against the independent simulation, frequency by frequency."""
