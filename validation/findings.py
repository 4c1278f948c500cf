"""What a case found: a claim, the number that decides it, and the limit it must keep."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Finding:
    """One claim. `value` and `limit` are in `unit`; a value that is not a number fails.

    Args:
        skipped: why the claim could not be tried on this machine; such a claim neither holds nor fails.
        regression: our code is compared with itself, run another way or at another time. It may fail as a claim does,
            and does not count as one.
        alternative: what the value would be if the claim were wrong.
        source: where the limit comes from. Both stand in the case's page where they are empty.
    """

    claim: str
    value: float
    limit: float
    unit: str
    skipped: str = ""
    regression: bool = False
    alternative: str = ""
    source: str = ""

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
        return f"{word}  {'regression check: ' if self.regression else ''}{self.outcome}"
