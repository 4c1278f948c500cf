"""From time to frequency: stepped-sine tests, sine fits, frequency responses, and a model's beside those measured."""

from pysim.identify.accuracy import (
    FREQUENCY_CRITERIA,
    TIME_CRITERIA,
    frequency_deviations,
    max_deviation,
    mean_deviation,
    response_difference,
    time_deviations,
)
from pysim.identify.frequency_response import (
    THESIS_REFERENCE_HZ,
    frequency_response,
    magnitude_db,
    standard_deviations,
)
from pysim.identify.frf import MeasuredResponse, SinePoint, Window, measured_responses, sine_point
from pysim.identify.logged import LoggedWave, logged_command, logged_wave
from pysim.identify.response_comparison import compare_responses
from pysim.identify.settling import SteadyRun, run_until_settled
from pysim.identify.sine_fit import SineFit, sine_fit
from pysim.identify.stepped_sine import SteppedSine, command, stepped_sine
from pysim.identify.transfer_function import TransferFunction
from pysim.types.fit import HALF_95

__all__ = [
    "FREQUENCY_CRITERIA",
    "HALF_95",
    "THESIS_REFERENCE_HZ",
    "TIME_CRITERIA",
    "LoggedWave",
    "MeasuredResponse",
    "SineFit",
    "SinePoint",
    "SteadyRun",
    "SteppedSine",
    "TransferFunction",
    "Window",
    "command",
    "compare_responses",
    "frequency_deviations",
    "frequency_response",
    "logged_command",
    "logged_wave",
    "magnitude_db",
    "max_deviation",
    "mean_deviation",
    "measured_responses",
    "response_difference",
    "run_until_settled",
    "sine_fit",
    "sine_point",
    "standard_deviations",
    "stepped_sine",
    "time_deviations",
]
