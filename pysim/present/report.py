"""A result shown by what it is: its text, its data, and a folder with pictures, files and a page."""

from __future__ import annotations

import shutil
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from importlib import import_module
from pathlib import Path
from typing import Any, Protocol, cast

from pysim.present.render import Drawing, Picture, draw

# The folder of an answer: its page, the names of our files, a line each, and what a stopped diagnosis goes on from.
PAGE, MARKER, CHECKPOINT = "report.html", ".pysim-answer", "checkpoint.jsonl"
NEW = ".pysim-new"  # in the folder while an answer is written
VIEWS = {  # type of a result -> the module that shows it, and that exports the type
    "Approximations": "pysim.present.multisine",
    "Checked": "pysim.present.fmu_check",
    "Chirps": "pysim.present.chirp",
    "CoSimulation": "pysim.present.cosim",
    "Comparison": "pysim.present.comparison",
    "Comparisons": "pysim.present.comparison",
    "DataCheck": "pysim.present.data_check",
    "Diagnosed": "pysim.present.diagnosis",
    "Diagnosis": "pysim.present.diagnosis",
    "Fit": "pysim.present.fit",
    "Fitted": "pysim.present.fit",
    "Friction": "pysim.present.friction",
    "Heave": "pysim.present.rig.heave",
    "Inside": "pysim.present.model",
    "Played": "pysim.present.excitation",
    "Responses": "pysim.present.frf",
    "Steps": "pysim.present.rig.steps",
    "TransferFunctions": "pysim.present.blackbox",
    "Tuning": "pysim.present.tuning",
}


class View(Protocol):
    """A module that shows the results of one method. A result without pictures needs `text` and `data` alone.

    It may also have `files(result) -> name -> content`, of what lies beside the page, and where its JSON names all
    files `placed(result, written, home) -> result`: `written` are the paths that `write_report` gives, `home` is the
    folder of the JSON file. A module that shows several types has `whole(result)`, which makes all of them one.
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
        """A self-contained HTML page; `redo` are the lines that make it again."""
        ...


def viewed(result: object) -> tuple[View, Any]:
    """The module that shows a result, and the result as that module takes it.

    Raises:
        TypeError: none shows results of this type, which is our mistake.
    """
    name = type(result).__name__
    if name in VIEWS:
        module = import_module(VIEWS[name])
        if getattr(module, name) is type(result):
            return cast(View, module), module.whole(result) if hasattr(module, "whole") else result
    raise TypeError(f"nothing in pysim.present shows a {type(result).__module__}.{name}; add it to VIEWS")


def text(result: object) -> str:
    """For a terminal."""
    view, whole = viewed(result)
    return view.text(whole)


def data(result: object) -> Any:
    """For JSON: plain numbers, texts, lists and dictionaries; what is not finite is None."""
    view, whole = viewed(result)
    return view.data(whole)


def write_report(folder: Path, result: object, *, redo: str = "") -> dict[str, Path]:
    """Write every picture as PNG and SVG, the files of the result and its page.

    Args:
        folder: that is there.
        redo: the lines that make it again; "" where there are none.
    Returns:
        name without suffix -> path: "report", each picture (PNG), each file.
    """
    from matplotlib import rc_context

    from pysim.io import write_file

    view, result = viewed(result)
    with rc_context({"text.parse_math": False}):  # a name of the user's with two dollars is no formula
        drawings = [draw(picture, folder) for picture in view.figures(result)]
    contents: Mapping[str, str | bytes] = view.files(result) if hasattr(view, "files") else {}
    for name, content in contents.items():
        write_file(folder / name, content)
    write_file(folder / PAGE, view.page(result, drawings, redo))
    written = {one.name: folder / f"{one.name}.png" for one in drawings}
    return {"report": folder / PAGE, **written, **{Path(name).stem: folder / name for name in contents}}


def mark(folder: Path, names: Iterable[str]) -> None:
    """Write the names of our files into the folder of an answer, so that the next one may replace them."""
    from pysim.io import write_file

    write_file(folder / MARKER, "".join(f"{name}\n" for name in sorted(names)))


def listed(folder: Path) -> set[str]:
    """Our files, by the marker."""
    marker = folder / MARKER
    return set(marker.read_text(encoding="utf-8", errors="replace").splitlines()) if marker.is_file() else set()


@contextmanager
def joining(folder: Path) -> Iterator[Path]:
    """Give a new folder, whose files join those of `folder` in the end: all of them, or none.

    A file of ours that is there is replaced; one of the user is not touched, and may be there if it is the same.

    Raises:
        BadInput: another file of the user is there, or the folder cannot be written.
    """
    from pysim.types import BadInput

    new, ours = folder / NEW, listed(folder)
    shutil.rmtree(new, ignore_errors=True)  # of a run that was killed
    with no_empty_folders([folder]):
        try:
            new.mkdir(parents=True)
        except OSError as error:
            raise BadInput(f"{folder}: cannot write there ({error.strerror or error}); name another folder") from error
        try:
            yield new
            files = {path.relative_to(new).as_posix(): path for path in new.rglob("*") if path.is_file()}
            if folder.suffix in {path.suffix for path in files.values()}:
                raise BadInput(
                    f"{folder}: what is written are {len(files)} files; name a folder, such as {folder.stem}"
                )
            theirs = {name for name in files if (folder / name).exists() and name not in ours}
            for name in theirs:
                if not (folder / name).is_file() or (folder / name).read_bytes() != files[name].read_bytes():
                    raise BadInput(
                        f"{folder / name} is there already and was not written by us; name another folder, or move it"
                    )
            mark(folder, ours | {*files} - theirs)
            for name, path in files.items():
                (folder / name).parent.mkdir(exist_ok=True)
                path.replace(folder / name)
        finally:
            shutil.rmtree(new, ignore_errors=True)


@contextmanager
def no_empty_folders(paths: Iterable[Path]) -> Iterator[None]:
    """Take away again what was made of these folders and those above them, where it is empty in the end."""
    made = {one for path in paths for one in (path, *path.parents) if not one.exists()}
    try:
        yield
    finally:
        for one in sorted(made, key=lambda one: -len(one.parts)):
            with suppress(OSError):  # it holds something
                one.rmdir()


def with_places(result: Any, written: Mapping[str, Path], home: Path) -> Any:
    """The result with the places of its files, where its JSON tells them.

    Args:
        written: as `write_report` gives them.
        home: the folder of the JSON file.
    """
    view, whole = viewed(result)
    return view.placed(whole, written, home) if hasattr(view, "placed") else result
