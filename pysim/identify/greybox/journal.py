"""The log of a search: a line per point for a reader, and the state that a killed search goes on from."""

from __future__ import annotations

import hashlib
import io
import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.evaluation import Evaluation
from pysim.identify.greybox.optimiser import State
from pysim.io import write_file
from pysim.types import BadInput, FitOutcome

Array = NDArray[np.float64]

LINES, STATE = "iterations.jsonl", "state.npz"


@dataclass(frozen=True)
class Journal:
    """Folder of one search.

    Each point is a line of iterations.jsonl: number, parameters in the model's units, cost (null for a bad point) and
    whether the step was taken. state.npz, always whole, is what the search goes on from; it says the same after a
    resume as without one, bit for bit.

    Args:
        folder: made where it is missing.
        identity: text that tells this search from any other: model, data, parameters, objective, optimiser, solver,
            start. Arrays enter it by their `digest`: printed they lose digits.
    """

    folder: Path
    identity: str

    @property
    def _token(self) -> str:
        return hashlib.sha256(self.identity.encode()).hexdigest()

    def forget(self) -> None:
        """Leave nothing to go on from; the lines stay until a search begins."""
        (self.folder / STATE).unlink(missing_ok=True)

    def begin(self) -> None:
        """Empty the log of what an earlier search left."""
        self.folder.mkdir(parents=True, exist_ok=True)
        self.forget()
        write_file(self.folder / LINES, "")

    def load(self) -> State | None:
        """Where the search stood, or None where there is nothing to go on from.

        Raises:
            BadInput: the log belongs to another search.
        """
        path = self.folder / STATE
        if not path.is_file():
            return None
        with np.load(path, allow_pickle=False) as content:
            head = json.loads(str(content["head"]))
            arrays = {name: content[name] for name in content.files}
        if head["token"] != self._token:
            raise BadInput(
                f"{path} belongs to another fit: other model, data, parameters, objective, optimiser, solver or start; "
                "repeat the command that was stopped, or delete this folder to begin anew"
            )
        self._forget_after(head["tried"])
        states, slopes = (_unpacked(arrays[name], arrays["known"]) for name in ("states", "state_slopes"))
        best = Evaluation(arrays["x"], float(arrays["cost"]), arrays["residual"], arrays["jacobian"], states, slopes)
        outcome = FitOutcome(head["outcome"]) if head["outcome"] else None
        memory = dict(zip(head["names"], arrays["memory"].tolist(), strict=True))
        return State(best, head["tried"], float(arrays["first_cost"]), memory, outcome, head["message"])

    def write(self, state: State, trial: Evaluation, values: dict[str, float]) -> None:
        """Add a point; the state is replaced only once the line stands."""
        line = {
            "iteration": state.tried,
            "cost": trial.cost if math.isfinite(trial.cost) else None,
            "taken": state.best is trial,
            "parameters": values,
            **({"trouble": trial.trouble} if trial.trouble else {}),
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
        best, buffer = state.best, io.BytesIO()
        np.savez(
            buffer,
            head=np.array(json.dumps(head)),
            memory=np.array(list(state.memory.values())),
            x=best.x,
            cost=np.array(best.cost),
            first_cost=np.array(state.first_cost),
            residual=best.residual,
            jacobian=best.jacobian,
            states=_packed(best.states),
            state_slopes=_packed(best.state_slopes),
            known=np.array([s is not None for s in best.states], dtype=bool),
        )
        return buffer.getvalue()

    def _forget_after(self, tried: int) -> None:
        """A line whose state was never written stands for a point that is tried again."""
        path = self.folder / LINES
        lines = path.read_text(encoding="utf-8").splitlines() if path.is_file() else []
        keep = []
        for line in lines:
            try:
                if json.loads(line)["iteration"] <= tried:
                    keep.append(line)
            except (json.JSONDecodeError, KeyError):
                break  # half a line, from the moment of the kill
        write_file(path, "".join(f"{line}\n" for line in keep))


def _packed(rows: Sequence[Array | None]) -> Array:
    """Equal arrays in one, (n, ...); zeros for None."""
    shape = next((row.shape for row in rows if row is not None), (0,))
    return np.array([np.zeros(shape) if row is None else row for row in rows]).reshape(len(rows), *shape)


def _unpacked(rows: Array, known: NDArray[np.bool_]) -> tuple[Array | None, ...]:
    return tuple(row if there else None for row, there in zip(rows, known, strict=True))
