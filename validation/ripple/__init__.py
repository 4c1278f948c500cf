"""The two ripple studies of thesis Section 4.5: a hose, and a relief valve tuned to the ripple."""
