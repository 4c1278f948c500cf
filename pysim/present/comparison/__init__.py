"""Models against measured responses, shown."""

from pysim.present.comparison.answer import (
    Comparisons,
    comparison_table,
    comparison_text,
    data,
    page,
    text,
    verdict_text,
    whole,
)
from pysim.present.comparison.figures import bode_figure, comparison_picture, deviation_figure, figures, picture_names
from pysim.types import Comparison

__all__ = [
    "Comparison",
    "Comparisons",
    "bode_figure",
    "comparison_picture",
    "comparison_table",
    "comparison_text",
    "data",
    "deviation_figure",
    "figures",
    "page",
    "picture_names",
    "text",
    "verdict_text",
    "whole",
]
