"""What a case found: a claim, the number that decides it, and the limit it must keep."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Cost:
    """What something took, kept so that runs can be compared over time.

    Args:
        what: the same words in every run.
        ours: in `unit`.
        unit: such as "s of CPU".
        peer: the other side that was measured in the same run, "" where there is none.
        theirs: what it took, in the same unit.
    """

    what: str
    ours: float
    unit: str
    peer: str = ""
    theirs: float | None = None


@dataclass(frozen=True)
class Finding:
    """One claim. `value` and `limit` are in `unit`; a value that is not a number fails.

    `skipped` says why the claim could not be tried on this machine; such a claim neither holds nor fails. `cost` is
    what a claim about speed is about.
    """

    claim: str
    value: float
    limit: float
    unit: str
    skipped: str = ""
    cost: Cost | None = None

    @property
    def holds(self) -> bool:
        """Whether the value keeps the limit."""
        return self.value <= self.limit

    @property
    def outcome(self) -> str:
        """Claim, value and limit, or why it was skipped."""
        if self.skipped:
            return f"{self.claim}: {self.skipped}"
        return f"{self.claim}: {f'{self.value:.4g} {self.unit}'.strip()}, limit {self.limit:g}"

    def __str__(self) -> str:
        word = "skipped" if self.skipped else "holds  " if self.holds else "FAILS  "
        return f"{word}  {self.outcome}"
