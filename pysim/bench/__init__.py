"""A virtual test bench: drive any FMU through a test plan and log it as a bench would."""

from pysim.bench.bench_tests import BenchTest, ChirpTest, MultisineTest, Run, SteppedSines, StepTest, WaveTest
from pysim.bench.logger import THESIS_LOGGER, Logger
from pysim.bench.plan import Plan
from pysim.bench.read_plan import named_plans, read_plan
from pysim.bench.run_plan import BenchData, run_plan
from pysim.bench.sensor import Sensor
from pysim.bench.truth import Truth, truth_data
from pysim.bench.write_commands import FORMS, write_commands

__all__ = [
    "FORMS",
    "THESIS_LOGGER",
    "BenchData",
    "BenchTest",
    "ChirpTest",
    "Logger",
    "MultisineTest",
    "Plan",
    "Run",
    "Sensor",
    "StepTest",
    "SteppedSines",
    "Truth",
    "WaveTest",
    "named_plans",
    "read_plan",
    "run_plan",
    "truth_data",
    "write_commands",
]
