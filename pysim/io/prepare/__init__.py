"""Steps that make raw logs ready: each a value that is listed, saved in dataset.toml and done again when that is read.

What is missing in a log stands as not-a-number in its column until a step fills it or cuts it out. Of an output it may
stay so: nothing is compared there.
"""

from pysim.io.prepare.cut import Exclude, HoldOut, Split, Trim
from pysim.io.prepare.filters import LowPass, Resample
from pysim.io.prepare.gaps import FillGaps, fill_of, refuse_missing_in, refuse_missing_samples
from pysim.io.prepare.log_names import logs_called, short_name
from pysim.io.prepare.outliers import DropOutliers, outliers
from pysim.io.prepare.signals import Delay, Detrend, Flip, Rename, Scaled
from pysim.io.prepare.step import Step, call, prepared, renamed_logs
from pysim.io.prepare.typed import step_typed, typed
from pysim.io.prepare.written import STEPS, is_off, step_of, values_of

__all__ = [
    "STEPS",
    "Delay",
    "Detrend",
    "DropOutliers",
    "Exclude",
    "FillGaps",
    "Flip",
    "HoldOut",
    "LowPass",
    "Rename",
    "Resample",
    "Scaled",
    "Split",
    "Step",
    "Trim",
    "call",
    "fill_of",
    "is_off",
    "logs_called",
    "outliers",
    "prepared",
    "refuse_missing_in",
    "refuse_missing_samples",
    "renamed_logs",
    "short_name",
    "step_of",
    "step_typed",
    "typed",
    "values_of",
]
