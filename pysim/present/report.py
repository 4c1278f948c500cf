"""The folder of a result: its pictures, its files and its page."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Protocol

from pysim.present.render import Drawing, Picture, draw

PAGE = "report.html"


class View(Protocol):
    """A module of `pysim.present` that shows the results of one method.

    It may also have `files(result) -> name -> content`, of what lies beside the page, and where its JSON names all
    files `placed(result, written, home) -> result`: `written` are the paths that `write_report` gives, `home` is the
    folder of the JSON file.
    """

    def text(self, result: Any) -> str:
        """For a terminal."""
        ...

    def data(self, result: Any) -> Any:
        """For JSON: numbers are finite or None."""
        ...

    def figures(self, result: Any) -> Iterable[Picture]:
        """One by one, so that only one is held at a time."""
        ...

    def page(self, result: Any, drawings: Sequence[Drawing], redo: str) -> str:
        """A self-contained HTML page; `redo` is the command line that makes it again."""
        ...


def write_report(folder: Path, result: object, view: View, *, redo: str) -> dict[str, Path]:
    """Write every picture as PNG and SVG, the files of the result and its page.

    Args:
        folder: that is there.
        view: the module that shows this kind of result.
        redo: the command line that makes it again.
    Returns:
        name without suffix -> path: "report", each picture (PNG), each file.
    """
    from pysim.io import write_file

    drawings = [draw(picture, folder) for picture in view.figures(result)]
    contents: Mapping[str, str | bytes] = view.files(result) if hasattr(view, "files") else {}
    for name, content in contents.items():
        write_file(folder / name, content)
    write_file(folder / PAGE, view.page(result, drawings, redo))
    written = {one.name: folder / f"{one.name}.png" for one in drawings}
    return {"report": folder / PAGE, **written, **{Path(name).stem: folder / name for name in contents}}
