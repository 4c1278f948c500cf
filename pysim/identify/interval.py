"""How wide an interval is drawn and told."""

HALF_95 = 1.959964  # half width of a 95 percent interval of a normal error, standard deviations
