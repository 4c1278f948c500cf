"""Laws that are learned: where they may stand, terms that try them, their curve, a formula for it, their class."""

from pysim.effects.learned.class_text import learned_class
from pysim.effects.learned.curve import curve_basis, widths
from pysim.effects.learned.formula import SHAPES, Formula, Shape, formulas
from pysim.effects.learned.laws import Law, laws_at
from pysim.effects.learned.places import LESS, TIME, Place, places
from pysim.effects.learned.terms import Term, wrapped

__all__ = [
    "LESS",
    "SHAPES",
    "TIME",
    "Formula",
    "Law",
    "Place",
    "Shape",
    "Term",
    "curve_basis",
    "formulas",
    "laws_at",
    "learned_class",
    "places",
    "widths",
    "wrapped",
]
