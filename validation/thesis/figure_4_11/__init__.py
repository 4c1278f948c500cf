"""Figure 4.11: a relief valve shaken by the ripple."""
