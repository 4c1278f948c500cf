"""Figures from what was measured and simulated; nothing is shown or written here."""

from pysim.present.render import render

__all__ = [
    "render",
]
