"""Figures from what was measured and simulated; nothing is shown or written here."""

from pysim.plot.blackbox import blackbox_figure
from pysim.plot.bode import bode_figure
from pysim.plot.chirp import chirp_figure
from pysim.plot.deviation import deviation_figure
from pysim.plot.excitation import excitation_figure
from pysim.plot.fit import (
    fit_correlation_figure,
    fit_harmonics_figure,
    fit_parameters_figure,
    fit_record_figure,
)
from pysim.plot.frf import frf_figure
from pysim.plot.friction import friction_figure
from pysim.plot.multisine import multisine_figure
from pysim.plot.render import render
from pysim.plot.time_response import time_response_figure

__all__ = [
    "blackbox_figure",
    "bode_figure",
    "chirp_figure",
    "deviation_figure",
    "excitation_figure",
    "fit_correlation_figure",
    "fit_harmonics_figure",
    "fit_parameters_figure",
    "fit_record_figure",
    "frf_figure",
    "friction_figure",
    "multisine_figure",
    "render",
    "time_response_figure",
]
