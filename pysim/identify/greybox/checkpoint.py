"""Checkpoint of a search, from which a killed search resumes; a readable log of its points; a digest of its input."""

from __future__ import annotations

import hashlib
import io
import json
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields, is_dataclass
from enum import Enum
from numbers import Real
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.optimiser import State
from pysim.identify.greybox.residuals import Carried, OwnStep, Point
from pysim.io import write_file
from pysim.types import BadInput, FitOutcome

Array = NDArray[np.float64]

LINES, STATE = "iterations.jsonl", "state.npz"


@dataclass(frozen=True)
class Checkpoint:
    """Folder of one search.

    Each point is a line of iterations.jsonl: number, parameters in the model's units, cost (null if the model could not
    be simulated) and whether the step was taken. state.npz is replaced as a whole, and a resumed search gives the same
    result as an uninterrupted one, bit for bit.

    Args:
        folder: made if it is missing.
        identity: text that differs between searches: model, data, parameters, objective, optimiser, solver, start.
            Arrays enter it by their `digest`, since printed arrays lose digits.
    """

    folder: Path
    identity: str

    @property
    def _token(self) -> str:
        """Of the search, and of the form in which a state is kept: another version's state cannot be gone on with."""
        return hashlib.sha256(f"{self.identity} {_PLAIN} {OwnStep._fields}".encode()).hexdigest()

    def forget(self) -> None:
        """Delete the state; the lines stay until a search begins."""
        (self.folder / STATE).unlink(missing_ok=True)

    def begin(self) -> None:
        """Delete state and lines of an earlier search."""
        self.folder.mkdir(parents=True, exist_ok=True)
        self.forget()
        write_file(self.folder / LINES, "")

    def load(self) -> State | None:
        """The last state, or None if there is none.

        Raises:
            BadInput: the state belongs to another search.
        """
        path = self.folder / STATE
        if not path.is_file():
            return None
        with np.load(path, allow_pickle=False) as content:
            head = json.loads(str(content["head"]))
            arrays = {name: content[name] for name in content.files}
        if head["token"] != self._token:
            raise BadInput(
                f"{path} belongs to another fit: other model, data, parameters, objective, optimiser, solver, start or "
                "version; repeat the command that was stopped, or delete this folder to begin anew"
            )
        self._forget_after(head["tried"])
        best = _point(arrays)
        outcome = FitOutcome(head["outcome"]) if head["outcome"] else None
        memory = dict(zip(head["names"], arrays["memory"].tolist(), strict=True))
        return State(best, head["tried"], float(arrays["first_cost"]), memory, outcome, head["message"])

    def write(self, state: State, trial: Point, values: dict[str, float]) -> None:
        """Add the line of a point, then replace the state."""
        line = {
            "iteration": state.tried,
            "cost": trial.cost if math.isfinite(trial.cost) else None,
            "taken": state.best is trial,
            "parameters": values,
            **({"trouble": str(trial.failure)} if trial.failure else {}),
            **({"outcome": state.outcome.value, "message": state.message} if state.outcome else {}),
        }
        with (self.folder / LINES).open("a", encoding="utf-8") as file:
            file.write(json.dumps(line) + "\n")
        write_file(self.folder / STATE, self._packed(state))

    def _packed(self, state: State) -> bytes:
        head = {
            "token": self._token,
            "tried": state.tried,
            "names": list(state.memory),
            "outcome": state.outcome.value if state.outcome else "",
            "message": state.message,
        }
        buffer = io.BytesIO()
        arrays: dict[str, Any] = {
            "head": np.array(json.dumps(head)),
            "memory": np.array(list(state.memory.values())),
            "first_cost": np.array(state.first_cost),
            **_arrays(state.best),
        }
        np.savez(buffer, **arrays)
        return buffer.getvalue()

    def _forget_after(self, tried: int) -> None:
        """Delete lines after point number `tried`: the search was killed before their state was written."""
        path = self.folder / LINES
        lines = path.read_text(encoding="utf-8").splitlines() if path.is_file() else []
        keep = []
        for line in lines:
            try:
                if json.loads(line)["iteration"] <= tried:
                    keep.append(line)
            except (json.JSONDecodeError, KeyError):
                break  # a line that was cut off when the search was killed
        write_file(path, "".join(f"{line}\n" for line in keep))


_PLAIN = ("x", "cost", "residual", "jacobian", "levels", "squares", "known", "more", "blocks", "series")


def _arrays(point: Point) -> dict[str, Array]:
    """A point as named arrays; what a run does not have is left out."""
    found = {name: np.asarray(getattr(point, name)) for name in _PLAIN}
    values = (*point.carried.states, point.carried.nuisances)
    for i, (value, step) in enumerate(zip(values, point.steps or (None,) * len(values), strict=True)):
        if value is not None:
            found[f"carried_{i}"] = value
        if step is not None:
            found |= {f"{name}_{i}": part for name, part in step._asdict().items()}
    return found | {"count": np.array(len(values)), "pieces": np.array(point.carried.pieces, dtype=np.int64)}


def _point(arrays: Mapping[str, Array]) -> Point:
    """The inverse of `_arrays`."""
    values, steps = [], []
    for i in range(int(arrays["count"])):
        values.append(arrays.get(f"carried_{i}"))
        own = [arrays[f"{name}_{i}"] for name in OwnStep._fields if f"{name}_{i}" in arrays]
        steps.append(OwnStep(*own) if own else None)
    nuisances = values.pop()
    assert nuisances is not None
    plain: dict[str, Any] = {name: float(arrays[name]) if arrays[name].ndim == 0 else arrays[name] for name in _PLAIN}
    carried = Carried(tuple(values), nuisances, tuple(arrays["pieces"].tolist()))
    return Point(**plain, carried=carried, steps=tuple(steps))


# Fields of a record that no residual depends on.
_SAID = ("origin", "message", "statistics")


def digest(content: object) -> str:
    """SHA-256 of nested dataclasses, mappings, tuples, lists, arrays, numbers and texts, exact to the last bit.

    Raises:
        TypeError: content of another type.
    """
    found = hashlib.sha256()
    for part in _exact(content):
        found.update(part)
    return found.hexdigest()


def _exact(content: object) -> Iterator[bytes]:
    """Bytes of the content, each value after its type and size, so that different contents give different bytes."""
    if isinstance(content, np.ndarray):
        yield f"array {content.dtype.str} {content.shape}\n".encode()
        yield content.tobytes()
    elif is_dataclass(content):
        names = [one.name for one in fields(content) if one.init and one.name not in _SAID]
        yield f"{type(content).__name__} {names}\n".encode()
        for name in names:
            yield from _exact(getattr(content, name))
    elif isinstance(content, Mapping):
        yield f"mapping {sorted(content)}\n".encode()
        for name in sorted(content):
            yield from _exact(content[name])
    elif isinstance(content, tuple | list):
        yield f"row {len(content)}\n".encode()
        for one in content:
            yield from _exact(one)
    elif isinstance(content, Real):
        yield f"{float(content).hex()}\n".encode()
    elif content is None or isinstance(content, str | Enum):
        yield f"{content!r}\n".encode()
    else:
        raise TypeError(f"{type(content).__name__} has no digest; add its exact form here")
