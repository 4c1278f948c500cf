"""What is killed: a build, a fit and a diagnosis, each with what it leaves when it is done."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any

from validation.kills.logs import LIBRARY, write_logs

_MODEL = ("--model", "Cart.Mass", "--library", str(LIBRARY))
_FMU, _JSON, _OUT = "Mass.fmu", "answer.json", "out"
_TIMES = frozenset({"seconds"})  # in an answer: how long it took, which no two runs share


@dataclass(frozen=True)
class Subject:
    """One kind of work.

    Args:
        words: behind `python -m`, run in a folder of its own; said again after a kill.
        prepare: what the folder has to hold.
        result: of that folder once the work is done.
        spoiled: what a kill has left half written there, in words; empty where nothing is.
        cold: whether its cache, and the C compiler's, are empty before each run.
        also_child: whether a kill may as well be of the process that it has started.
    """

    words: tuple[str, ...]
    prepare: Callable[[Path], None]
    result: Callable[[Path], Any]
    spoiled: Callable[[Path], str]
    cold: bool = False
    also_child: Callable[[Path], int] | None = None


def _nothing(folder: Path) -> None:
    """An empty folder will do."""


def _logs(folder: Path) -> None:
    write_logs(folder / "data")


def _fmu(folder: Path) -> str:
    return hashlib.sha256((folder / _FMU).read_bytes()).hexdigest()


def read_answer(path: Path) -> Any:
    """An answer in JSON without its times."""
    return _same(json.loads(path.read_text(encoding="utf-8")))


def _same(found: Any) -> Any:
    """Without what differs between any two runs."""
    if isinstance(found, dict):
        return {name: _same(value) for name, value in found.items() if name not in _TIMES}
    return [_same(one) for one in found] if isinstance(found, list) else found


def half_answer(path: Path) -> str:
    """An answer is there as a whole, or not at all."""
    try:
        json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        return ""
    except ValueError as error:
        return f"{path.name} is half written ({error})"
    return ""


def _half_fmu(folder: Path) -> str:
    import zipfile

    path = folder / _FMU
    try:
        with zipfile.ZipFile(path) as archive:
            bad = archive.testzip()
    except FileNotFoundError:
        return ""
    except zipfile.BadZipFile as error:
        return f"{_FMU} is half written ({error})"
    return f"{_FMU} is half written ({bad})" if bad else ""


def _command(name: str, *more: str) -> Subject:
    words = ("pysim", name, "data", *_MODEL, *more, "--output", _OUT, "--json", _JSON)
    return Subject(words, _logs, lambda folder: read_answer(folder / _JSON), lambda folder: half_answer(folder / _JSON))


SUBJECTS: Mapping[str, Subject] = MappingProxyType(
    {
        "build": Subject(
            ("fmu_build", "Cart.Mass", "--library", str(LIBRARY), "-o", _FMU), _nothing, _fmu, _half_fmu, cold=True
        ),
        "fit": _command("fit", "--starts", "2", "--seed", "1"),
        "diagnosis": _command("diagnose"),
    }
)
