"""What is dropped on the page: taken in pieces, limited, unpacked within the project, and put where it belongs."""

from __future__ import annotations

import shutil
import zipfile
from collections.abc import AsyncIterator, Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path, PurePosixPath, PureWindowsPath
from secrets import token_urlsafe

from pysim.app.bare_logs import add_logs
from pysim.app.description import refuse_outside
from pysim.app.project import Project
from pysim.io import DAMAGED, counted, same_file, unusable_name
from pysim.io.load import READERS
from pysim.types import BadInput

_PIECE = 2**20
_LONGEST, _BYTES = 200, 255  # letters of a name, and what disks keep of it in UTF-8


@dataclass(frozen=True)
class Limits:
    """How much may be dropped at a time, in bytes and files; unpacked content counts as well."""

    size: int = 256 * 2**20
    files: int = 5000

    @property
    def words(self) -> str:
        """For messages."""
        return f"{self.size / 2**20:g} MB in {self.files} files"


@dataclass
class Batch:
    """One drop while it comes in. What it refuses, as too much or names that do not fit, is a `BadInput`.

    Args:
        folder: where its files are kept until it is complete.
        limits: refused beyond.
    """

    folder: Path
    limits: Limits
    name: str = field(default_factory=lambda: token_urlsafe(9))
    size: int = 0
    files: int = 0
    whole: int = 0  # of the files, those that have arrived to their last byte
    _taken: dict[str, str] = field(default_factory=dict)  # what same_file says -> name

    async def take(self, name: str, pieces: AsyncIterator[bytes], *, size: int) -> None:
        """One file, as it comes in. It gets its name once it is whole; of one that broke off nothing stays.

        Args:
            size: bytes that its sender announced.
        """
        target = self.target(name)
        self.count(size, name)
        partial = target.with_name(f".{token_urlsafe(9)}.part")
        seen = 0
        try:
            with partial.open("wb") as file:
                async for piece in pieces:
                    seen += len(piece)
                    if seen > size:
                        break
                    file.write(piece)
            if seen != size:
                raise BadInput(f"{name} did not arrive whole ({seen} bytes where {size} were announced); drop it again")
            partial.replace(target)
            self.whole += 1
        finally:
            partial.unlink(missing_ok=True)

    def target(self, name: str) -> Path:
        """Where a file of that name goes; its folders are made.

        Raises:
            BadInput: a name that would leave the folder, that not every system keeps or that the drop has already,
                or one file too many.
        """
        parts = _parts(name)
        bad = not parts or ".." in parts or parts[0] == "/" or PureWindowsPath(name).drive or "\0" in name
        long = any(len(part) > _LONGEST or len(part.encode()) > _BYTES for part in parts)  # no disk keeps it
        if bad or long or not name.isprintable() or len(parts) > 20:
            raise BadInput(f"{name[:80]!r} is no name of a file below the dropped folder; rename it")
        if why := unusable_name("/".join(parts)):  # behind a colon Windows would lose the log in another file's stream
            raise BadInput(f"{name[:80]!r}: {why}; rename it")
        self.files += 1
        if self.files > self.limits.files:
            raise BadInput(f"more than {self.limits.files} files; drop at most {self.limits.words}")
        plain = "/".join(parts)
        if before := self._taken.get(same_file(plain)):
            raise BadInput(f"{plain} and {before} would be one file; rename one of them, or drop one at a time")
        self._taken[same_file(plain)] = plain
        target = self.folder / self.name / Path(*parts)
        try:
            target.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise BadInput(f"{name}: cannot be kept ({error.strerror}); rename it") from error
        return target

    def count(self, size: int, name: str) -> None:
        """So many bytes more."""
        self.size += size
        if self.size > self.limits.size:
            raise BadInput(f"{name} goes beyond the limit; drop at most {self.limits.words}")

    def end(self) -> None:
        """Remove what is left of it, and of what was made of it."""
        for one in self.folder.glob(f"{self.name}*"):
            shutil.rmtree(one, ignore_errors=True)

    def unpack(self) -> None:
        """Put the content of every .zip in its place."""
        for path in sorted((self.folder / self.name).rglob("*")):
            if path.is_file() and path.suffix.lower() == ".zip":
                try:
                    self._unpack(path)
                except (*DAMAGED, OSError) as error:
                    raise BadInput(f"{path.name} cannot be unpacked: {error}; pack it again") from error
                path.unlink()

    def _unpack(self, path: Path) -> None:
        place = path.relative_to(self.folder / self.name)
        with zipfile.ZipFile(path) as archive:
            for member in archive.infolist():
                if member.is_dir() or _hidden(_parts(member.filename)):
                    continue
                name = (place.parent / member.filename).as_posix() if place.parent.parts else member.filename
                target = self.target(name)
                with archive.open(member) as source, target.open("wb") as file:
                    while piece := source.read(_PIECE):  # what the archive says of sizes is not believed
                        self.count(len(piece), member.filename)
                        file.write(piece)


@dataclass(frozen=True)
class Adopted:
    """What a drop turned out to be: "dataset", "logs" that nobody has described yet, or "model"."""

    kind: str
    text: str
    model: str = ""
    libraries: tuple[str, ...] = ()


def replaces(batch: Batch, project: Project) -> bool:
    """Whether a complete drop would take the place of the data set that is there; `BadInput` as of `adopt`."""
    _sweep(batch.folder / batch.name)
    batch.unpack()
    return project.data.exists() and any((batch.folder / batch.name).rglob("dataset.toml"))


def adopt(batch: Batch, project: Project) -> Adopted:
    """Put a complete drop where it belongs in the project.

    Raises:
        BadInput: nothing in it that could be used, or two data sets.
    """
    root = batch.folder / batch.name
    try:
        _sweep(root)
        batch.unpack()
        described = _described([path for path in _files(root) if path.name == "dataset.toml"])
        models = [path for path in _files(root) if path.suffix.lower() in (".fmu", ".mo")]
        if described:  # a model below its folder is part of it
            models = [path for path in models if path.parent == _single(root)]
        model = _model(root, models, project) if models else None  # with all that is in its library
        logs = [path for path in _files(root) if path.suffix.lower() in READERS]
        if model is not None and described is None and all(path.suffix.lower() == ".txt" for path in logs):
            return model  # a text beside a model is about it
        if described is None and not logs:
            found = ", ".join(sorted({path.suffix or path.name for path in _files(root)})[:6]) or "nothing"
            taken = ", ".join(READERS)
            raise BadInput(f"no data set, no logs and no model in this: {found}; drop logs as {taken}")
        if described:
            data = Adopted("dataset", f"A data set was taken over{_kept(project.replace_data(described.parent))}")
        else:
            data = _logs(root, logs, project)
        return data if model is None else replace(model, kind=data.kind, text=f"{model.text}; {data.text}")
    finally:
        batch.end()


def _logs(root: Path, logs: Sequence[Path], project: Project) -> Adopted:
    folder, count, more = _single(root), counted(len(logs), "log"), project.data.exists()
    if more:
        folder = add_logs(folder, project.data, root.with_name(f"{root.name}-all"))
    kept = project.replace_data(folder)
    text = f"{count} {'more' if more else 'without a dataset.toml; say below what their columns are'}{_kept(kept)}"
    return Adopted("logs", text)


def _files(root: Path) -> list[Path]:
    return sorted(path for path in root.rglob("*") if path.is_file())


def _sweep(root: Path) -> None:
    """Remove what is hidden, and folders that have nothing else: they would be taken for the user's."""
    for path in sorted(root.rglob("*"), reverse=True):  # what is in a folder before the folder
        if path.is_dir():
            if not any(path.iterdir()):
                path.rmdir()
        elif _hidden(path.relative_to(root).parts):
            path.unlink()


def _hidden(parts: Sequence[str]) -> bool:
    """What systems leave beside a user's files."""
    return any((part.startswith(".") and part != "..") or part == "__MACOSX" for part in parts)


def _parts(name: str) -> list[str]:
    """Folders and file of a name, whatever the system that wrote it."""
    return [part for part in PurePosixPath(name.replace("\\", "/")).parts if part != "."]


def _described(descriptions: Sequence[Path]) -> Path | None:
    """The only dataset.toml; None without one."""
    if len(descriptions) > 1:
        raise BadInput(f"{len(descriptions)} files dataset.toml in this; drop one data set at a time")
    for one in descriptions:
        refuse_outside(one)
    return next(iter(descriptions), None)


def _kept(place: str) -> str:
    """What became of what was there before, to be added to a sentence."""
    return f"; what was there before is in {place}" if place else ""


def _single(root: Path) -> Path:
    """The folder that was dropped, where it is the only thing in the drop."""
    inside = list(root.iterdir())
    return inside[0] if len(inside) == 1 and inside[0].is_dir() else root


def _model(root: Path, models: list[Path], project: Project) -> Adopted:
    """An FMU becomes the model; a package or .mo file a library."""
    fmus = [path for path in models if path.suffix.lower() == ".fmu"]
    if len(fmus) > 1:
        raise BadInput(f"{len(fmus)} FMUs in this; drop the one to be compared")
    tops = list(_tops(root, [path for path in models if path not in fmus]))
    taken = [path.name for path in [*tops, *fmus]]
    for name in taken:
        if sum(name.casefold() == other.casefold() for other in taken) > 1:
            raise BadInput(f"more than one {name} in this; drop the one that is meant")
    kept = project.replace_models([*fmus, *tops])  # an FMU within a library leaves it first
    names = [(project.models / name).relative_to(project.folder).as_posix() for name in taken]
    text = f"taken over: {', '.join(taken)}{_kept(kept)}"
    return Adopted("model", text, names[-1] if fmus else "", tuple(names[: len(tops)]))


def _tops(root: Path, sources: list[Path]) -> Iterator[Path]:
    """Folders of packages, and .mo files that belong to none."""
    packages = sorted({p.parent for p in sources if p.name == "package.mo"}, key=lambda p: len(p.parts))
    outer = [p for p in packages if p != root and not any(p != q and p.is_relative_to(q) for q in packages)]
    yield from outer
    yield from (p for p in sources if not any(p.is_relative_to(q) for q in outer))
