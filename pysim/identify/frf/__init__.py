"""Frequency responses from measured logs of stepped sines, with their covariance."""

from pysim.identify.frf.noise import ResidualNoise, residual_noise
from pysim.identify.frf.responses import MeasuredResponse, measured_responses
from pysim.identify.frf.sine_point import SinePoint, Window, sine_point

__all__ = [
    "MeasuredResponse",
    "ResidualNoise",
    "SinePoint",
    "Window",
    "measured_responses",
    "residual_noise",
    "sine_point",
]
