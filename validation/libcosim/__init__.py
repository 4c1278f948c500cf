"""The co-simulation master against libcosim."""
