"""The blind benchmark of the diagnosis, and the plant behind it."""
