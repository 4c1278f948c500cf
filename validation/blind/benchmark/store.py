"""Answers on disk: a file of lines per kind of case; what was answered again later counts."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from pysim.io import write_file
from validation.blind.benchmark.answer import Answer
from validation.blind.plant import Case

ANSWERS = Path(__file__).parent / "answers"
PLACES = Path(__file__).parent / "places"
"""Where effects were located, the rest of the diagnosis left out."""
FOLLOWED = Path(__file__).parent / "followed"
"""What became of ties once the next test was carried out."""
CLOCKED = Path(__file__).parent / "clocked"
"""How long a case took with both cores for itself."""

AGAIN = Path(__file__).parent / "again"
"""What was answered to cases whose older answers count."""


@dataclass(frozen=True)
class Store:
    """A folder with one file per kind. Several processes may add to it at once: each line goes out in one piece."""

    folder: Path = ANSWERS

    def add(self, case: Case, answer: Answer) -> None:
        """Append it; a line that a kill has cut before is closed first."""
        self.folder.mkdir(parents=True, exist_ok=True)
        path = self._path(case.kind)
        cut = path.is_file() and path.stat().st_size > 0 and not path.read_bytes().endswith(b"\n")
        text = ("\n" if cut else "") + answer.line() + "\n"
        handle = os.open(path, os.O_WRONLY | os.O_APPEND | os.O_CREAT | getattr(os, "O_BINARY", 0), 0o644)
        try:
            os.write(handle, text.encode())
        finally:
            os.close(handle)

    def read(self) -> dict[str, Answer]:
        """Case -> its latest answer; half a line, from the moment of a kill, is none."""
        return {answer.case: answer for path in sorted(self.folder.glob("*.jsonl")) for answer in _answers(path)}

    def tidy(self, table: Sequence[Case]) -> None:
        """Write each kind anew: the latest answer of each case of the table, in its order. Not while a run goes on."""
        known = self.read()
        for kind in dict.fromkeys(case.kind for case in table):
            lines = [known[case.name].line() for case in table if case.kind == kind and case.name in known]
            if lines:
                write_file(self._path(kind), "\n".join([*lines, ""]))

    def _path(self, kind: str) -> Path:
        return self.folder / f"{kind}.jsonl"


def _answers(path: Path) -> Iterator[Answer]:
    for line in path.read_text(encoding="utf-8").splitlines():
        try:
            yield Answer.read(line)
        except ValueError:
            continue
