"""Comparisons as text, as data and as one self-contained HTML page."""

from pysim.present.page import cell, commands, heading, items, page, paragraph, picture, table

__all__ = [
    "cell",
    "commands",
    "heading",
    "items",
    "page",
    "paragraph",
    "picture",
    "table",
]
