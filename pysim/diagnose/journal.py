"""What a diagnosis has found so far, a line per finished part: a killed one goes on from there."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from pysim.diagnose.subject import Subject
from pysim.diagnosis.checkpoint import whole_lines
from pysim.identify.greybox.checkpoint import digest
from pysim.io import write_file
from pysim.types import BadInput

# Raised whenever the same line would mean something else.
_FORM = 2


class Journal:
    """Results by name, kept in a file of JSON lines if there is one; the first line says whose they are.

    Only what cannot be had quickly from other lines is kept: points and what was concluded, not residuals and slopes.

    Args:
        path: made where it is missing; None keeps nothing beyond this object.
        identity: text that tells this diagnosis from any other.
    Raises:
        BadInput: the file belongs to another diagnosis, or is none.
    """

    def __init__(self, path: Path | None, identity: str) -> None:
        self._path, self._known = path, dict[str, Any]()
        self.reused, self._mark = 0, ""
        if path is None:
            return
        head = {"diagnosis": hashlib.sha256(identity.encode()).hexdigest(), "form": _FORM}
        lines = whole_lines(path, "journal")
        if lines and lines[0] != head:
            raise BadInput(
                f"{path} is the journal of another diagnosis: other model, data, libraries or options, or an older "
                "program; delete it to begin anew, or write to another folder"
            )
        self._known = {line["part"]: line["result"] for line in lines[1:]}
        path.parent.mkdir(parents=True, exist_ok=True)
        write_file(path, "".join(json.dumps(line) + "\n" for line in (lines or [head])))

    def once(self, part: str, find: Callable[[], Any]) -> Any:
        """The result of a part: from the file, or found now and written there.

        Args:
            part: its name, the same in every run.
            find: gives what JSON can hold; numbers come back bit for bit.
        """
        part = self._mark + part
        if part in self._known:
            self.reused += 1
            return self._known[part]
        result = find()
        self._known[part] = result
        if self._path is not None:
            with self._path.open("a", encoding="utf-8") as file:
                file.write(json.dumps({"part": part, "result": result}) + "\n")
        return result

    def afresh(self) -> None:
        """Parts from here on are others, though they have the names of earlier ones."""
        self._mark += "again: "


def identity(subject: Subject, settings: Mapping[str, object]) -> str:
    """Text that is the same for the same model, data, catalogue and settings only."""
    model, data = hashlib.sha256(subject.model.path.read_bytes()).hexdigest(), subject.dataset
    measured = digest((subject.targets, () if data is None else (data.signals, data.records)))
    catalogue = [(e.name, e.class_name, e.law, repr(e.parameters)) for e in subject.catalogue]
    bounds = sorted((name, *ends) for name, ends in subject.bounds.items())
    return repr((model, measured, subject.free, bounds, catalogue, sorted(settings.items())))
