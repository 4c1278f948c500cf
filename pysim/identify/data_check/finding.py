"""A finding of the data check: a code, its values, and the steps of preparation that correct it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum

from pysim.io.prepare import Step
from pysim.types._frozen import FrozenMapping


class FindingCode(Enum):
    """Kind of a finding, in the order of correction. The comments list the keys of `Finding.values`."""

    NOT_IN_MODEL = "not_in_model"  # signal, known (names), maybe still (name of a parameter): it is not compared
    NOT_DRIVEN = "not_driven"  # signal, value, unit: an input of the model that no signal drives
    EMPTY = "empty"  # signal, count, start (s): cells without a number
    GAP = "gap"  # count, start, length (s): samples were lost
    QUANTITY = "quantity"  # signal, unit, wanted, maybe factor: the model counts it in another quantity
    SWAPPED = "swapped"  # signal, other, maybe correlation: each follows the model's answer for the other one
    SIGN = "sign"  # signal, correlation, maybe logs (names): it moves against the model's answer
    TURNED_INPUT = "turned_input"  # signal, outputs, maybe logs: these move with the answer once the input is turned
    FACTOR = "factor"  # signal, factor, maybe logs: it is so many times the model's answer
    CLIPPED = "clipped"  # signal, count, low, high, unit: it stands at the end of its range
    OUTLIERS = "outliers"  # signal, count, start (s): single samples far off their neighbours
    UNEVEN = "uneven"  # jitter (share of the interval), rate (Hz)
    TOO_SHORT = "too_short"  # rows, least
    SLOW_CLOCK = "slow_clock"  # rate (Hz): times may be in ms
    STILL = "still"  # signal, value, unit: it never moves
    FOLDED = "folded"  # signal, share: of its variance close to half the sampling rate
    FEW_PERIODS = "few_periods"  # periods, frequency
    ALIASED = "aliased"  # harmonic, frequency, rate
    NO_SINE = "no_sine"  # signal, reason: what the fit of the sine said
    FREQUENCY = "frequency"  # signal, value, told (Hz)
    IMPURE = "impure"  # signal, share
    LEVEL = "level"  # what ("offset" or "amplitude"), signal, value, told, unit


@dataclass(frozen=True)
class Finding:
    """One possible error in the data.

    Args:
        code: its kind.
        source: source of the record; the first record if it is about a signal.
        values: numbers and names, with the keys that are listed at the code.
        cure: steps of preparation that correct it, in order; none if only a new test or description does.
    """

    code: FindingCode
    source: str
    values: Mapping[str, float | str]
    cure: tuple[Step, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "values", FrozenMapping(self.values))


def finding(code: FindingCode, source: str, *cure: Step, **values: float | str) -> Finding:
    """Make a finding, with its values as keyword arguments."""
    return Finding(code, source, values, cure)
