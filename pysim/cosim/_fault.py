"""What goes wrong inside a run, with the name of the member it went wrong in."""

from __future__ import annotations

from pysim.types import Outcome


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
    kind = "" if hasattr(error, "outcome") else f"{type(error).__name__}: "
    return Fault(name, f"{kind}{error}", outcome)
