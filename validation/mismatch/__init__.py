"""A diagnosis tried on data sets whose laws no catalogue holds: its names, and its error on a log that it never saw."""
