"""PI controllers for linear plants by loop shaping: phase margin and crossover in, gains out."""

from pysim.control.tuning.bench_plants import TABLE_6_1, load_pressure_plant, shaft_speed_plant
from pysim.control.tuning.loop_response import LoopResponse, loop_response
from pysim.control.tuning.margins import Margins, margins, stable_when_sampled
from pysim.control.tuning.pi_gains import Gains, fastest_pi, known_pi, reachable_phase_margins, tune_pi
from pysim.control.tuning.plant import Plant
from pysim.control.tuning.shaft_mode import coupled_poles, damping_gain, growth, steady_above

__all__ = [
    "TABLE_6_1",
    "Gains",
    "LoopResponse",
    "Margins",
    "Plant",
    "coupled_poles",
    "damping_gain",
    "fastest_pi",
    "growth",
    "known_pi",
    "load_pressure_plant",
    "loop_response",
    "margins",
    "reachable_phase_margins",
    "shaft_speed_plant",
    "stable_when_sampled",
    "steady_above",
    "tune_pi",
]
