"""Checkpoint of a diagnosis: a line per finished part of the search, from which a stopped diagnosis goes on."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from pysim.diagnosis.candidate import Candidate
from pysim.diagnosis.refit import FinalFit, again
from pysim.diagnosis.session import Session
from pysim.identify.greybox import Simulation
from pysim.identify.greybox.checkpoint import digest
from pysim.identify.greybox.residuals import Carried
from pysim.io import write_file
from pysim.types import BadInput, FitOutcome

_FORM = 4  # version of the format; raise it when a line changes its meaning


class Checkpoint:
    """Finished refits by the part of the search, in a file of JSON lines whose first line identifies the diagnosis.

    Args:
        path: of the file, created if it is missing; None keeps nothing.
        whose: text that identifies the diagnosis, as `whose` makes it.
    Raises:
        BadInput: the file belongs to another diagnosis, or is no checkpoint.
    """

    def __init__(self, path: Path | None, whose: str) -> None:
        self._path, self._known = path, dict[str, list[dict[str, Any]]]()
        self._found: dict[str, list[FinalFit]] = {}
        if path is None:
            return
        head = {"diagnosis": hashlib.sha256(whose.encode()).hexdigest(), "form": _FORM}
        lines = whole_lines(path, "checkpoint")
        if lines and lines[0] != head:
            raise BadInput(
                f"{path} is the checkpoint of another diagnosis: other model, data, libraries or options, or an older "
                "program; delete it to begin anew, or write to another folder"
            )
        self._known = {line["part"]: line["fits"] for line in lines[1:]}
        path.parent.mkdir(parents=True, exist_ok=True)
        write_file(path, "".join(json.dumps(line) + "\n" for line in (lines or [head])))

    def once(
        self,
        part: str,
        find: Callable[[], Sequence[FinalFit]],
        candidates: Sequence[Candidate],
        like: Simulation,
    ) -> list[FinalFit]:
        """The refits of one part: found now and saved, or known, those of the file simulated once at their ends.

        Args:
            part: its name, the same whenever this diagnosis runs.
            candidates: all that the part may have refitted.
            like: solver settings of its refits, but for their tolerances.
        """
        if part in self._found:
            return self._found[part]
        if part in self._known:
            known = {(candidate.labels, candidate.transient): candidate for candidate in candidates}
            self._found[part] = [
                _fit(known[tuple(row["labels"]), row["transient"]], row, like) for row in self._known[part]
            ]
            return self._found[part]
        found = self._found[part] = list(find())
        if self._path is not None:
            rows = [_row(fit) for fit in found]
            with self._path.open("a", encoding="utf-8") as file:
                file.write(json.dumps({"part": part, "fits": rows}) + "\n")
        return found


def _row(fit: FinalFit) -> dict[str, Any]:
    carried, outcome, solver = fit.point.carried, fit.state.outcome, fit.simulation.solver
    return {
        "labels": fit.candidate.labels,
        "transient": fit.candidate.transient,
        "x": fit.point.x.tolist(),
        "states": [None if state is None else state.tolist() for state in carried.states],
        "sizes": carried.nuisances.tolist(),
        "solver": {"rtol": solver.rtol, "atol": solver.atol, "max_steps": solver.max_steps},
        "mismatch": fit.simulation.mismatch,
        "outcome": outcome.name if outcome else None,
        "tried": fit.state.tried,
        "memory": dict(fit.state.memory),
    }


def _fit(candidate: Candidate, row: Mapping[str, Any], like: Simulation) -> FinalFit:
    states = tuple(None if state is None else np.array(state) for state in row["states"])
    simulation = replace(like, solver=replace(like.solver, **row["solver"]), mismatch=row["mismatch"])
    fit = again(candidate, np.array(row["x"]), Carried(states, np.array(row["sizes"])), simulation)
    outcome = FitOutcome[row["outcome"]] if row["outcome"] else None
    return replace(fit, state=replace(fit.state, tried=row["tried"], memory=row["memory"], outcome=outcome))


def whole_lines(path: Path, what: str) -> list[dict[str, Any]]:
    """JSON lines up to the first incomplete one, which a killed process leaves; empty if there is no file.

    Raises:
        BadInput: the first line is not JSON; the message calls the file `what`.
    """
    found: list[dict[str, Any]] = []
    for line in path.read_text(encoding="utf-8").splitlines() if path.is_file() else ():
        try:
            found.append(json.loads(line))
        except json.JSONDecodeError:
            if not found:
                raise BadInput(f"{path} is no {what} of a diagnosis; name another file") from None
            break
    return found


def whose(session: Session, step: str) -> str:
    """Text that identifies a diagnosis: it changes with step, model, data, parameters, catalogue and settings."""
    model = hashlib.sha256(session.model.path.read_bytes()).hexdigest()
    data = session.dataset
    measured = digest((data.signals, data.records, tuple(sorted(session.data.overrides.items()))))
    catalogue = [(e.name, e.class_name, e.law, repr(e.parameters)) for e in session.catalogue]
    begins = [(p.name, session.begins.get(p.name, session.model[p.name].start)) for p in session.parameters]
    return repr((step, model, measured, session.parameters, begins, catalogue, session.treatment, session.settings))
