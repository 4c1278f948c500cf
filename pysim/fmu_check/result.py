"""What a check says of an FMU."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import Any

HOLDS, DOUBTFUL, FAILS, SKIPPED = "holds", "doubtful", "fails", "skipped"
VERDICTS = (HOLDS, DOUBTFUL, FAILS, SKIPPED)


@dataclass(frozen=True)
class CheckResult:
    """One claim about an FMU. `value` and `limit` are in `unit`, None where the claim is not about a number."""

    check: str
    claim: str
    verdict: str  # "holds" | "doubtful": allowed by FMI, but look at it | "fails" | "skipped"
    detail: str = ""  # which variables, or why it was skipped
    value: float | None = None
    limit: float | None = None
    unit: str = ""

    def __str__(self) -> str:
        number = "" if self.value is None else f" ({self.value:.3g}{f', limit {self.limit:g}' if self.limit else ''}"
        number += f" {self.unit})" if number and self.unit else ")" if number else ""
        return f"{self.verdict:<9}{self.check}: {self.claim}{number}{f': {self.detail}' if self.detail else ''}"

    def data(self) -> dict[str, Any]:
        """For JSON: a value that is no number is None."""
        data = asdict(self)
        if self.value is not None and not math.isfinite(self.value):
            data["value"] = None
        return data


def within(check: str, claim: str, value: float, limit: float, unit: str, detail: str = "") -> CheckResult:
    """Holds where the value keeps the limit; a value that is no number fails."""
    return CheckResult(check, claim, HOLDS if value <= limit else FAILS, detail, value, limit, unit)


def none_of(check: str, claim: str, names: Iterable[str], *, otherwise: str = FAILS, note: str = "") -> CheckResult:
    """Holds where there are no names; otherwise the first of them are named."""
    found = list(names)
    if not found:
        return CheckResult(check, claim, HOLDS, note)
    more = f" and {len(found) - _NAMED} more" if len(found) > _NAMED else ""
    return CheckResult(check, claim, otherwise, ", ".join(found[:_NAMED]) + more)


def skipped(check: str, claim: str, why: str) -> CheckResult:
    """Could not be tried."""
    return CheckResult(check, claim, SKIPPED, why)


_NAMED = 6
