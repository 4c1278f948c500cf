"""The pump's FMU against the independent simulation, over time."""
