"""Sensitivities and periodic orbits at the cost a fit can afford."""
