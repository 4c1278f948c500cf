"""What can be put into a model's slots: the catalogue of effects, and the class of a model that has some of them."""

from pysim.effects._text import declares
from pysim.effects.catalogue import STANDARD_LIBRARY, VENDOR, Pair, law_constants, read_catalogue, read_pairs
from pysim.effects.law_class import law_class, parameter_text, slot_units
from pysim.effects.sketch import Sketch, law_sketch
from pysim.effects.slots import Filling, Slot, filling, fitting, slots
from pysim.effects.variant import Variant, variant, variant_text

__all__ = [
    "STANDARD_LIBRARY",
    "VENDOR",
    "Filling",
    "Pair",
    "Sketch",
    "Slot",
    "Variant",
    "declares",
    "filling",
    "fitting",
    "law_class",
    "law_constants",
    "law_sketch",
    "parameter_text",
    "read_catalogue",
    "read_pairs",
    "slot_units",
    "slots",
    "variant",
    "variant_text",
]
