"""What was chosen, step by step: undo and redo write the same bytes again."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping

from pysim.app.project import VALUES, Project
from pysim.io import write_file
from pysim.present.notes import listed

_Bytes = dict[str, bytes | None]  # name of a file -> what is in it; None where it is not there
CHOICES = {  # key of what results depend on -> what it is
    "model": "the model", "libraries": "the libraries", "free": "what is fitted", "bounds": "the bounds",
    "initial": "how the logs begin", "use": "what logs are used for", "preparation": "the steps of preparation",
}  # fmt: skip
_ALL = CHOICES | {"added": "the effects", "look": "the look", "deleted": "a deleted branch", "names": "a name"}


class History:
    """Of the files of a project in which choices stand.

    `past` and `future` are earlier states, and those that were undone; the nearest one last. `held` is the last one
    of which there were results.
    """

    def __init__(self, project: Project) -> None:
        self._project = project
        self.past: list[_Bytes] = []
        self.future: list[_Bytes] = []
        self.now = self._read()
        self.held: _Bytes = {}

    def look(self) -> None:
        """See whether something was chosen since."""
        now = self._read()
        if now != self.now:
            self.past.append(self.now)
            self.future.clear()
            self.now = now

    def begin_anew(self) -> None:
        """Nothing of before can be undone: other logs or another library lie there now."""
        self.past.clear()
        self.future.clear()
        self.now, self.held = self._read(), {}

    def undo(self) -> None:
        """One step back."""
        self._to(self.past, self.future)

    def redo(self) -> None:
        """One step forward."""
        self._to(self.future, self.past)

    def _to(self, there: list[_Bytes], here: list[_Bytes]) -> None:
        self.look()
        if not there:
            return
        before, self.now = self.now, there.pop()
        here.append(before)
        for path in self._project.choices:
            content = self.now[path.name]
            if content is None:
                path.unlink(missing_ok=True)
            elif content != before[path.name]:  # else its time would make results look old
                write_file(path, content)

    def _read(self) -> _Bytes:
        return {path.name: path.read_bytes() if path.is_file() else None for path in self._project.choices}


def changed(before: _Bytes, after: _Bytes, known: Mapping[str, str] = _ALL) -> str:
    """What was chosen otherwise, for people: the keys of lines that differ; of settings, those that are known count."""
    found = []
    for name, text in before.items():
        one, other = (Counter((content or b"").decode(errors="replace").split("\n")) for content in (text, after[name]))
        for key in (line.partition(" = ")[0].strip('"') for line in (one - other) + (other - one) if " = " in line):
            word = key if name == VALUES else known.get(key, "the logs" * (name == "dataset.toml"))
            found += [word] * bool(word)
    return listed([*dict.fromkeys(found)])
