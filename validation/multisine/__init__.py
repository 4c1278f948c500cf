"""Best linear approximations against exact sums, textbook formulae and stepped sines."""
