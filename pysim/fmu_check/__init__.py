"""Checks of anybody's FMU, as a strict importer would try it; each in a process that the FMU may crash."""

from pysim.fmu_check.check import FmuReport, check_fmu
from pysim.fmu_check.checks import CHECKS
from pysim.fmu_check.result import DOUBTFUL, FAILS, HOLDS, SKIPPED, VERDICTS, CheckResult

__all__ = [
    "CHECKS",
    "DOUBTFUL",
    "FAILS",
    "HOLDS",
    "SKIPPED",
    "VERDICTS",
    "CheckResult",
    "FmuReport",
    "check_fmu",
]
