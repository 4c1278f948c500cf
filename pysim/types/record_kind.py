"""The kinds of records that a data set may hold: what each must state, and how it is simulated and compared."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from types import MappingProxyType


class Command(Enum):
    """How the command of a record runs between its samples."""

    SINE = "sine"  # the closed form, fitted to the logged command
    CHIRP = "chirp"  # the same of a sweep
    SPLINE = "spline"  # a cubic spline through the samples, from jump to jump
    LINES = "lines"  # straight lines from sample to sample
    STEPS = "steps"  # held until the next sample


HOLDS: Mapping[str, Command] = MappingProxyType(
    {"zero": Command.STEPS, "linear": Command.LINES, "spline": Command.SPLINE}
)  # as dataset.toml spells how an input runs between samples


class Compared(Enum):
    """What of a record is compared with the model."""

    SAMPLES = "samples"
    HARMONICS = "harmonics"
    RESPONSE = "response"  # magnitude and phase over frequency


@dataclass(frozen=True)
class RecordKind:
    """One kind.

    Args:
        name: as dataset.toml spells it.
        about: what the record is of, in a few words.
        needs: keys that dataset.toml must give.
        command: how the command runs between samples; None of a table, which has none.
        compared: what of it is compared.
        broad: whether the command excites a band of frequencies.
    """

    name: str
    about: str
    needs: tuple[str, ...]
    command: Command | None
    compared: Compared
    broad: bool


STEPPED_SINE = RecordKind(
    "frequency-response",
    "a sine of one frequency",
    ("offset", "amplitude", "frequency"),
    Command.SINE,
    Compared.HARMONICS,
    broad=False,
)
CHIRP = RecordKind("chirp", "a sine sweep", ("offset", "amplitude"), Command.CHIRP, Compared.SAMPLES, broad=True)
STOCHASTIC = RecordKind("stochastic", "a random wave", (), Command.SPLINE, Compared.SAMPLES, broad=True)
MULTISINE = RecordKind("multisine", "a periodic sum of sines", (), Command.SPLINE, Compared.SAMPLES, broad=True)
STEP = RecordKind("step", "steps", (), Command.STEPS, Compared.SAMPLES, broad=False)
OTHER = RecordKind("other", "any other log over time", (), Command.SPLINE, Compared.SAMPLES, broad=False)
RESPONSE_TABLE = RecordKind(
    "frequency-response-table", "a table of magnitude and phase", (), None, Compared.RESPONSE, broad=True
)

KINDS: Mapping[str, RecordKind] = MappingProxyType(
    {kind.name: kind for kind in (STEPPED_SINE, CHIRP, STOCHASTIC, MULTISINE, STEP, OTHER, RESPONSE_TABLE)}
)
LOGS = tuple(kind for kind in KINDS.values() if kind.command is not None)
