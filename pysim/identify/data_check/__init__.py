"""What a data set holds, and what about it should be looked at before anything is fitted."""

from pysim.identify.data_check.check import DataCheck, RecordCheck, check_dataset
from pysim.identify.data_check.clipping import plateaus
from pysim.identify.data_check.clock import Clock, clock
from pysim.identify.data_check.finding import Finding, FindingCode
from pysim.identify.data_check.folding import share_near_nyquist
from pysim.identify.data_check.held import Between, between_samples
from pysim.identify.data_check.one_cause import with_one_cause
from pysim.identify.data_check.swing import Swing, swing

__all__ = [
    "Between",
    "Clock",
    "DataCheck",
    "Finding",
    "FindingCode",
    "RecordCheck",
    "Swing",
    "between_samples",
    "check_dataset",
    "clock",
    "plateaus",
    "share_near_nyquist",
    "swing",
    "with_one_cause",
]
