"""What a case found: a claim, the number that decides it, and the limit it must keep."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Finding:
    """One claim. `value` and `limit` are in `unit`; a value that is not a number fails.

    `skipped` says why the claim could not be tried on this machine; such a claim neither holds nor fails.
    """

    claim: str
    value: float
    limit: float
    unit: str
    skipped: str = ""

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
