"""The ripple behind a hose and at a relief valve, each against a calculation without the FMU."""

from __future__ import annotations

from collections.abc import Iterator

from validation.findings import Finding
from validation.ripple import hose, relief


def run() -> Iterator[Finding]:
    """The hose of Fig. 4.9, then the valve of Fig. 4.11."""
    yield from hose.findings()
    yield from relief.findings()
