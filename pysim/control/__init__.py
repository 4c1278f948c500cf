"""Controllers as small blocks: sampled (thesis Section 5.4)."""

from pysim.control.bench_controllers import CompensatedLoadController, LoadController, SpeedController
from pysim.control.block import Block
from pysim.control.pi import PI
from pysim.control.signals import Gain, Limiter, NormalizeSignal, ZeroSwitch, load_feed_forward, speed_feed_forward
from pysim.control.valve_compensation import ValveCompensation
from pysim.types import Port

__all__ = [
    "PI",
    "Block",
    "CompensatedLoadController",
    "Gain",
    "Limiter",
    "LoadController",
    "NormalizeSignal",
    "Port",
    "SpeedController",
    "ValveCompensation",
    "ZeroSwitch",
    "load_feed_forward",
    "speed_feed_forward",
]
