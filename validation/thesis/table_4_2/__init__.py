"""Table 4.2: the pressure drop over the orifice."""
