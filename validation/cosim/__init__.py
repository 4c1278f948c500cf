"""The co-simulation master against monolithic solutions, closed forms and a plain loop."""
