"""The only things that cross folders: frozen, checked once, numpy and the standard library only."""

from pysim.types._sampling import Sampling, sampling
from pysim.types.answer import (
    Diagnosis,
    ErrorStep,
    Failure,
    FloorSource,
    FoundEffect,
    GainTest,
    LearnedLaw,
    Left,
    NextTest,
    NoiseFloor,
    PlannedTest,
    Rival,
    Verdict,
)
from pysim.types.answer_json import answer_data, law_data, read_step, step_data
from pysim.types.best_linear_approximation import BestLinearApproximation, Distortion, Level, MultisineTest
from pysim.types.comparison import Comparison, ResponseComparison
from pysim.types.criterion import Criterion, Deviation
from pysim.types.dataset import Dataset, MeasuredRecord, MeasuredSignal
from pysim.types.effect import Effect, EffectParameter
from pysim.types.errors import BadInput, printable, with_place
from pysim.types.experiment import Experiment, rows_every
from pysim.types.fit import (
    Combination,
    Direction,
    Estimate,
    Fit,
    FitOutcome,
    Harmonics,
    RecordFit,
    ResponseFit,
    Start,
)
from pysim.types.frequency_response import FrequencyResponse
from pysim.types.model import Abilities, CoSimulation, Model, Variable
from pysim.types.note import Note, NoteCode
from pysim.types.port import Port
from pysim.types.progress_event import ProgressEvent, Trial
from pysim.types.record import Outcome, Record, SimulationError
from pysim.types.record_kind import KINDS, RecordKind
from pysim.types.setting import setting
from pysim.types.signal import Signal
from pysim.types.sine_test import SineTest
from pysim.types.units import SECONDS, SI, SYNONYMS, UNITS, conversion, in_si

__all__ = [
    "KINDS",
    "SECONDS",
    "SI",
    "SYNONYMS",
    "UNITS",
    "Abilities",
    "BadInput",
    "BestLinearApproximation",
    "CoSimulation",
    "Combination",
    "Comparison",
    "Criterion",
    "Dataset",
    "Deviation",
    "Diagnosis",
    "Direction",
    "Distortion",
    "Effect",
    "EffectParameter",
    "ErrorStep",
    "Estimate",
    "Experiment",
    "Failure",
    "Fit",
    "FitOutcome",
    "FloorSource",
    "FoundEffect",
    "FrequencyResponse",
    "GainTest",
    "Harmonics",
    "LearnedLaw",
    "Left",
    "Level",
    "MeasuredRecord",
    "MeasuredSignal",
    "Model",
    "MultisineTest",
    "NextTest",
    "NoiseFloor",
    "Note",
    "NoteCode",
    "Outcome",
    "PlannedTest",
    "Port",
    "ProgressEvent",
    "Record",
    "RecordFit",
    "RecordKind",
    "ResponseComparison",
    "ResponseFit",
    "Rival",
    "Sampling",
    "Signal",
    "SimulationError",
    "SineTest",
    "Start",
    "Trial",
    "Variable",
    "Verdict",
    "answer_data",
    "conversion",
    "in_si",
    "law_data",
    "printable",
    "read_step",
    "rows_every",
    "sampling",
    "setting",
    "step_data",
    "with_place",
]
