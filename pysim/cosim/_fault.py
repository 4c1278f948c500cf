"""What goes wrong inside a run, with the name of the member it went wrong in."""

from __future__ import annotations

import traceback
from pathlib import Path

from pysim.types import Outcome

_OURS = Path(__file__).parents[1]


class Fault(Exception):
    """A member could not go on.

    Args:
        name: of the member.
        why: end of the sentence.
    """

    def __init__(self, name: str, why: str, outcome: Outcome) -> None:
        super().__init__(f"{name}: {why}")
        self.outcome = outcome


def fault(name: str, error: Exception) -> Fault:
    """What a member raised, as a fault of that member."""
    if isinstance(error, Fault):
        return error
    outcome = getattr(error, "outcome", Outcome.MODEL_ERROR)
    if hasattr(error, "outcome"):
        return Fault(name, str(error), outcome)
    return Fault(name, f"{type(error).__name__}: {error}{_place(error)}", outcome)


def _place(error: Exception) -> str:
    """File and line of a block that is not ours, where it raised."""
    frames = traceback.extract_tb(error.__traceback__)
    if not frames or Path(frames[-1].filename).is_relative_to(_OURS):
        return ""
    return f" ({Path(frames[-1].filename).name}, line {frames[-1].lineno})"
