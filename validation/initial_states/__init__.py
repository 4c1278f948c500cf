"""Fits of logs that do not begin at rest, whose truth is known in closed form."""
