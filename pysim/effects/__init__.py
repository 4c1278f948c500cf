"""What can be put into a model's slots: the catalogue of effects, and the class of a model that has some of them."""

from pysim.effects._text import declares
from pysim.effects.catalogue import STANDARD_LIBRARY, VENDOR, Pair, law_constants, read_catalogue, read_pairs
from pysim.effects.events import makes_events
from pysim.effects.law_class import LawRefused, law_class, law_equations, parameter_text, slot_units
from pysim.effects.law_units import parameter_units
from pysim.effects.sketch import Sketch, law_sketch
from pysim.effects.slots import Filling, Slot, filling, fitting, slots
from pysim.effects.variant import Variant, variant, variant_text

__all__ = [
    "STANDARD_LIBRARY",
    "VENDOR",
    "Filling",
    "LawRefused",
    "Pair",
    "Sketch",
    "Slot",
    "Variant",
    "declares",
    "filling",
    "fitting",
    "law_class",
    "law_constants",
    "law_equations",
    "law_sketch",
    "makes_events",
    "parameter_text",
    "parameter_units",
    "read_catalogue",
    "read_pairs",
    "slot_units",
    "slots",
    "variant",
    "variant_text",
]
