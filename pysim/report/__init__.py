"""Comparisons as text, as data and as one self-contained HTML page."""

from pysim.present.page import cell, commands, heading, items, page, paragraph, picture, table
from pysim.report.comparison import comparison_page, comparison_table
from pysim.report.data import comparison_data
from pysim.report.text import comparison_text, verdict_text

__all__ = [
    "cell",
    "commands",
    "comparison_data",
    "comparison_page",
    "comparison_table",
    "comparison_text",
    "heading",
    "items",
    "page",
    "paragraph",
    "picture",
    "table",
    "verdict_text",
]
