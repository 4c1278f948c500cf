"""Frequency responses from one chirp: by the maxima, by the minima, and their mean (thesis Section 2.5)."""

from pysim.identify.chirp.analysis import analyse_chirp, chirp_responses
from pysim.identify.chirp.branch import Branch
from pysim.identify.chirp.result import ChirpAnalysis
from pysim.identify.chirp.sweep import fastest_rate, sweep_error

__all__ = ["Branch", "ChirpAnalysis", "analyse_chirp", "chirp_responses", "fastest_rate", "sweep_error"]
