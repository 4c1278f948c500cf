"""What was chosen, step by step: undo and redo write the same bytes again."""

from __future__ import annotations

from pysim.app.project import Project
from pysim.io import write_file

_Bytes = dict[str, bytes | None]  # name of a file -> what is in it; None where it is not there


class History:
    """Of the files of a project in which choices stand.

    `past` and `future` are earlier states, and those that were undone; the nearest one last.
    """

    def __init__(self, project: Project) -> None:
        self._project = project
        self.past: list[_Bytes] = []
        self.future: list[_Bytes] = []
        self._now = self._read()

    def look(self) -> None:
        """See whether something was chosen since."""
        now = self._read()
        if now != self._now:
            self.past.append(self._now)
            self.future.clear()
            self._now = now

    def begin_anew(self) -> None:
        """Nothing of before can be undone: other logs or another library lie there now."""
        self.past.clear()
        self.future.clear()
        self._now = self._read()

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
        before, self._now = self._now, there.pop()
        here.append(before)
        for path in self._project.choices:
            content = self._now[path.name]
            if content is None:
                path.unlink(missing_ok=True)
            elif content != before[path.name]:  # else its time would make results look old
                write_file(path, content)

    def _read(self) -> _Bytes:
        return {path.name: path.read_bytes() if path.is_file() else None for path in self._project.choices}
