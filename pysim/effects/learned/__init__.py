"""Laws that were learned: their curve between knots, a formula for it, and the Modelica class that has one of them."""

from pysim.effects.learned.class_text import learned_class
from pysim.effects.learned.curve import curve_basis, widths
from pysim.effects.learned.formula import SHAPES, Formula, Shape, formulas

__all__ = ["SHAPES", "Formula", "Shape", "curve_basis", "formulas", "learned_class", "widths"]
