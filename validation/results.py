"""What running a case gave, and how it is kept: a line of JSON with commit, date and machine."""

from __future__ import annotations

import json
import math
import os
import platform
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from pysim.io import write_file
from validation.findings import Finding
from validation.registry import CASES

HOLDS, FAILS, SKIPPED = "holds", "fails", "skipped"
_CPU_INFO = Path("/proc/cpuinfo")


@dataclass(frozen=True)
class Machine:
    """Where a case ran, as far as it decides how long things take."""

    system: str
    processor: str
    cores: int
    python: str

    def __str__(self) -> str:
        return f"{self.processor}, {self.cores} cores, {self.system}, Python {self.python}"


@dataclass(frozen=True)
class CaseResult:
    """One run of a case.

    `error` is the last line of what stopped it, "" where it came to its end. `commit` is of the checkout, with "-dirty"
    behind it where code or data differed from that commit, and "" where it is not known.
    """

    case: str
    about: str
    group: str
    date: str  # UTC, ISO 8601, to the second
    seconds: float  # by the wall clock
    cpu: float  # s of all processors, of processes started too; not what others on the machine make one wait for
    machine: Machine
    findings: tuple[Finding, ...]
    error: str = ""
    commit: str = ""
    seeds: str = ""  # with which this process drew random numbers, such as "1, 3 to 402"; "" where it drew none

    @property
    def verdict(self) -> str:
        """ "fails" where a claim fails or the case stopped; "skipped" where no claim could be tried."""
        tried = [finding for finding in self.findings if not finding.skipped]
        if self.error or not all(finding.holds for finding in tried):
            return FAILS
        return HOLDS if tried else SKIPPED

    def count(self, verdict: str) -> int:
        """How many claims came out that way, without regression checks."""
        return sum(verdict_of(finding) == verdict and not finding.regression for finding in self.findings)

    @property
    def checks(self) -> tuple[Finding, ...]:
        """The regression checks that were tried."""
        return tuple(finding for finding in self.findings if finding.regression and not finding.skipped)


def verdict_of(finding: Finding) -> str:
    """ "holds", "fails" or "skipped"."""
    return SKIPPED if finding.skipped else HOLDS if finding.holds else FAILS


def this_machine() -> Machine:
    """The machine this runs on."""
    system = f"{platform.system()} {platform.machine()}"
    return Machine(system, _processor(), os.cpu_count() or 1, platform.python_version())


def _processor() -> str:
    if _CPU_INFO.is_file():
        for line in _CPU_INFO.read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    return platform.processor() or "unknown processor"


def append_results(path: Path, results: Iterable[CaseResult]) -> None:
    """Add a line for each; makes the file and its folder."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("a", encoding="utf-8", newline="\n") as file:
        file.writelines(to_line(result) + "\n" for result in results)


def keep_results(path: Path, results: Iterable[CaseResult]) -> tuple[CaseResult, ...]:
    """Put these runs in place of former ones of the same cases.

    Dropped are runs of cases that are gone, and those whose commit nobody noted: nobody can say what they are of.

    Returns:
        what the file holds now: the last run of each case, in the order of the registry.
    """
    last = newest([*read_results(path), *results])
    kept = tuple(last[name] for name in CASES if name in last and last[name].commit)
    write_file(path, "".join(to_line(result) + "\n" for result in kept))
    return kept


def read_results(path: Path) -> tuple[CaseResult, ...]:
    """All lines, oldest first; none where there is no file."""
    if not path.is_file():
        return ()
    return tuple(from_line(line) for line in path.read_text(encoding="utf-8").splitlines() if line.strip())


def newest(results: Iterable[CaseResult]) -> dict[str, CaseResult]:
    """The last run of each case."""
    return {result.case: result for result in sorted(results, key=lambda result: result.date)}


def to_line(result: CaseResult) -> str:
    """JSON without line breaks; a value that is no number is written as null."""
    data = asdict(result)
    for finding in data["findings"]:
        for name in ("value", "limit"):
            number = float(finding[name])
            finding[name] = float(f"{number:.6g}") if math.isfinite(number) else None
        for name in ("skipped", "regression", "alternative", "source"):
            if not finding[name]:
                del finding[name]
    data["seconds"], data["cpu"] = round(result.seconds, 1), round(result.cpu, 1)
    return json.dumps(data, ensure_ascii=False)


def from_line(line: str) -> CaseResult:
    """The other way."""
    data = json.loads(line)
    findings = tuple(_finding(row) for row in data.pop("findings"))
    return CaseResult(machine=Machine(**data.pop("machine")), findings=findings, **data)


def _finding(row: dict[str, Any]) -> Finding:
    return Finding(**{**row, **_numbers(row)})


def _numbers(row: dict[str, float | None]) -> dict[str, float]:
    return {name: math.nan if row[name] is None else float(row[name] or 0.0) for name in ("value", "limit")}
