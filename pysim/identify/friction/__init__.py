"""Friction of a shaft: torque balance from logs, samples by filter or by pulses, and the fit of thesis Eq. 5.38."""

from pysim.identify.friction.correlated import correlation_length, score_covariance
from pysim.identify.friction.filtering import local_slope, settling_time, zero_phase
from pysim.identify.friction.fit import FRICTION_BOUNDS, FrictionFit, fit_friction
from pysim.identify.friction.law import (
    FRICTION_NAMES,
    FRICTION_UNITS,
    friction_slopes,
    friction_torque,
    mean_friction,
    mean_slopes,
)
from pysim.identify.friction.pulses import PulseIntervals, pulse_intervals, pulse_speed, pulse_times
from pysim.identify.friction.samples import FrictionSamples, filtered_samples, pulse_samples
from pysim.identify.friction.shaft import ShaftColumns, ShaftTest, shaft_tests

__all__ = [
    "FRICTION_BOUNDS",
    "FRICTION_NAMES",
    "FRICTION_UNITS",
    "FrictionFit",
    "FrictionSamples",
    "PulseIntervals",
    "ShaftColumns",
    "ShaftTest",
    "correlation_length",
    "filtered_samples",
    "fit_friction",
    "friction_slopes",
    "friction_torque",
    "local_slope",
    "mean_friction",
    "mean_slopes",
    "pulse_intervals",
    "pulse_samples",
    "pulse_speed",
    "pulse_times",
    "score_covariance",
    "settling_time",
    "shaft_tests",
    "zero_phase",
]
