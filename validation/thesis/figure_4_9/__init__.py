"""Figure 4.9: the ripple before and after a hose."""
