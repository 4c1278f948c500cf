"""Test signals: values that know their command as a closed form with its exact derivative (thesis Section 2.1)."""

from pysim.excitation.chirp import Chirp
from pysim.excitation.excitation import Excitation
from pysim.excitation.lead_in import LeadIn
from pysim.excitation.line_grid import LineGrid
from pysim.excitation.multisine import Multisine
from pysim.excitation.spectrum import PiersonMoskowitz
from pysim.excitation.step import Step
from pysim.excitation.stepped_sine import SteppedSineCommand
from pysim.excitation.stochastic import StochasticWave

__all__ = [
    "Chirp",
    "Excitation",
    "LeadIn",
    "LineGrid",
    "Multisine",
    "PiersonMoskowitz",
    "Step",
    "SteppedSineCommand",
    "StochasticWave",
]
