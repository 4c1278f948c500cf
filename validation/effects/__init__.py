"""Every two effects of the catalogue in one pump."""
