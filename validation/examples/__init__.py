"""Every model of the libraries that runs by itself, against a stored result of another solver."""
