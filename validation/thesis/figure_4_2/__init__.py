"""Figures 4.2 and 4.3: the response with an orifice as load against that without."""
