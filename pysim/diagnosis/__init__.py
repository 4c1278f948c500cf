"""Which physical effect is missing: the steps in a row, and each of them alone."""
