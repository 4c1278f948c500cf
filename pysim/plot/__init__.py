"""Figures from what was measured and simulated; nothing is shown or written here."""

from pysim.plot.bode import bode_figure
from pysim.plot.chirp import chirp_figure
from pysim.plot.cosim import cosim_figure
from pysim.plot.deviation import deviation_figure
from pysim.plot.diagnosis import diagnosis_ledger_figure, diagnosis_ranking_figure
from pysim.plot.diagnosis_parameters import diagnosis_parameters_figure
from pysim.plot.diagnosis_records import diagnosis_overlay_figure, telling_records
from pysim.plot.diagnosis_spectrum import diagnosis_spectrum_figure
from pysim.plot.diagnosis_where import diagnosis_failures_figure, diagnosis_map_figure
from pysim.plot.excitation import excitation_figure
from pysim.plot.missing import missing_figure
from pysim.plot.multisine import multisine_figure
from pysim.plot.time_response import time_response_figure
from pysim.present.render import render

__all__ = [
    "bode_figure",
    "chirp_figure",
    "cosim_figure",
    "deviation_figure",
    "diagnosis_failures_figure",
    "diagnosis_ledger_figure",
    "diagnosis_map_figure",
    "diagnosis_overlay_figure",
    "diagnosis_parameters_figure",
    "diagnosis_ranking_figure",
    "diagnosis_spectrum_figure",
    "excitation_figure",
    "missing_figure",
    "multisine_figure",
    "render",
    "telling_records",
    "time_response_figure",
]
