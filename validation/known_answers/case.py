"""Pump and test bench with known answers: what is missing, how large it is, how good the model is with it."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from validation.findings import Finding
from validation.known_answers.answers import TODAY, answer
from validation.known_answers.machines import MACHINES, Machine

_HELD = 1.1  # error over noise on logs that were held out or never given
_LEARNED = 1.5  # the same, where the law has to be learned
_OFF = 0.01  # of a true value, that an estimate may be off where its interval misses it


def run() -> Iterator[Finding]:
    """Each machine in turn: verdict, effects, their numbers, and the error on logs that were not fitted."""
    for name, machine in MACHINES.items():
        yield from findings(name, machine, answer(name))


def findings(name: str, machine: Machine, found: Mapping[str, Any]) -> Iterator[Finding]:
    """Of one machine."""
    added = [one["effect"] for one in found["added"]]
    wrong = (found["verdict"], added) != (machine.verdict, list(machine.right))
    right = f"right is {machine.verdict} ({', '.join(machine.right) or 'nothing added'})"
    said = f"{found['verdict']} ({', '.join(added) or 'nothing added'})"
    yield Finding(f"{name}, {machine.about}: {said}, {right}", float(wrong), 0, "wrong")
    true = machine.truth(found)
    for one in found["added"] if sorted(added) == sorted(machine.right) else ():
        for parameter, value in one["parameters"].items():
            key = f"{one['effect']}.{parameter}"
            if key in true:
                yield _number(f"{name}: {key}", value, one["intervals"][parameter], true[key])
    held, limit = found["error"][-1]["validate"], _LEARNED if machine.unknown else _HELD
    yield Finding(f"{name}: held out, by its own account", held * (machine.stated or 1.0), limit, "x noise")
    if machine.unseen is not None and not machine.unknown:
        yield Finding(f"{name}: on a log that it was not given", machine.unseen(found), _HELD, "x noise")


def _number(what: str, value: float, interval: Sequence[float | None], true: float) -> Finding:
    low, high = (end if end is not None else math.nan for end in interval)
    inside = low <= true <= high
    about = f"{what} {value:.4g}, {low:.4g} to {high:.4g}, right is {true:.4g}; off where the interval misses it"
    return Finding(about, 0.0 if inside else abs(value / true - 1), _OFF, "")


def notes() -> Sequence[str]:
    """Which commit's answers are stored, and for which machines there are none."""
    stored = json.loads(TODAY.read_text(encoding="utf-8"))
    missing = [name for name in MACHINES if name not in stored["answers"]]
    commit = f"today.json holds what the code of commit {stored['commit']} answered"
    return (f"{commit}; not run: {', '.join(missing) or 'none'}.",)
