"""Which importers take our FMUs, and whether they get the same out of them."""
