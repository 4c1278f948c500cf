"""A project: a folder with a data set, settings and results, all in files that the command line reads as well."""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import re
import shutil
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import cache, lru_cache
from pathlib import Path
from typing import Any

from pysim.app.disk import move_all
from pysim.app.lock import LOCK
from pysim.io import read_toml, toml_key, toml_table, write_file
from pysim.types import BadInput

_SETTINGS, VALUES = "project.toml", "parameters.toml"
_OWN = (_SETTINGS, VALUES, "data", "model", "laws", "earlier", "uploads", "results", LOCK)
LOOKS = ("auto", "light", "dark")


@dataclass(frozen=True)
class Settings:
    """What the user chose.

    Args:
        model: a Modelica class, or an .fmu as it is seen from the project: `model/Pump.fmu`.
        libraries: of the user's, below the project.
        free: parameters that may be refitted; empty: all that the model bounds.
        added: effects that the model has now, in order.
        look: of the page, one of LOOKS.
        bounds: of parameters that differ from the model's, as `--bounds` takes them: "d=20:60".
        deleted: folders of results that are not shown; the next server removes them.
        names: of branches: effects, joined by "+", "=" and what the user calls the model with them.
    """

    model: str = ""
    libraries: tuple[str, ...] = ()
    free: tuple[str, ...] = ()
    added: tuple[str, ...] = ()
    look: str = "auto"
    bounds: tuple[str, ...] = ()
    deleted: tuple[str, ...] = ()
    names: tuple[str, ...] = ()

    @property
    def named(self) -> dict[str, str]:
        """Effects, joined by "+" -> name of their branch."""
        return {key: name for key, _, name in (one.partition("=") for one in self.names)}

    @property
    def ranges(self) -> dict[str, tuple[float, float]]:
        """Parameter -> lowest and highest value, of those that a fit may change."""
        found = {}
        for one in self.bounds:
            name, _, ends = one.rpartition("=")
            try:
                low, high = (float(end) for end in ends.split(":"))
            except ValueError:
                raise BadInput(f'{_SETTINGS}: bounds {one!r} are none; write "NAME=LOW:HIGH"') from None
            if not self.free or name in self.free:
                found[name] = low, high
        return found


@dataclass(frozen=True)
class Project:
    """The folder; everything is read from it again when it is asked for, so that two pages never differ.

    A file that somebody broke is a `BadInput`.
    """

    folder: Path

    @classmethod
    def at(cls, folder: Path) -> Project:
        """The project in a folder, which is made where it is missing.

        Raises:
            BadInput: a folder that cannot be written, or one that holds something else.
        """
        folder = folder.resolve()
        if folder.is_dir() and any(folder.iterdir()) and not (folder / _SETTINGS).is_file():
            raise BadInput(f"{folder} holds files but no {_SETTINGS}; name a new folder, or that of a project")
        try:
            folder.mkdir(parents=True, exist_ok=True)
            project = cls(folder)
            if not (folder / _SETTINGS).is_file():
                project.save(Settings())
        except OSError as error:
            raise BadInput(
                f"{folder}: cannot write there ({error.strerror or error}); choose another folder"
            ) from error
        project.settings()
        return project

    @property
    def data(self) -> Path:
        """Where the data set is; not there before one was dropped."""
        return self.folder / "data"

    @property
    def models(self) -> Path:
        """Where the user's models and libraries are."""
        return self.folder / "model"

    @property
    def laws(self) -> Path:
        """Where the classes of laws are that were written on the page; each is a library of one effect."""
        return self.folder / "laws"

    @property
    def libraries(self) -> tuple[str, ...]:
        """Those of the user and each law, as they are seen from the project."""
        laws = sorted(path.relative_to(self.folder).as_posix() for path in self.laws.glob("*.mo"))
        return (*self.settings().libraries, *laws)

    @property
    def uploads(self) -> Path:
        """Where a drop comes in and what is thrown away goes; a server that starts empties it."""
        return self.folder / "uploads"

    @property
    def description(self) -> Path:
        """The data set's dataset.toml."""
        return self.data / "dataset.toml"

    @property
    def choices(self) -> tuple[Path, ...]:
        """Files in which the user's choices stand."""
        return self.folder / _SETTINGS, self.folder / VALUES, self.description

    @property
    def empty(self) -> bool:
        """Whether nothing was dropped or named yet."""
        return not self.data.exists() and not self.settings().model

    def results(self, name: str) -> Path:
        """The folder of one result."""
        return self.folder / "results" / name

    def settings(self) -> Settings:
        """As they are on disk."""
        path = self.folder / _SETTINGS
        try:
            found = tomllib.loads(path.read_text(encoding="utf-8"))
            known = {f.name for f in fields(Settings)}
            values: dict[str, Any] = {k: tuple(v) if isinstance(v, list) else v for k, v in found.items() if k in known}
            settings = Settings(**values)
        except (OSError, ValueError, TypeError, RecursionError) as error:
            raise BadInput(f"{path}: {error}; correct it, or remove it to begin anew") from error
        for one in fields(Settings):
            if not isinstance(getattr(settings, one.name), type(one.default)):
                raise BadInput(f"{path}: {one.name} is {getattr(settings, one.name)!r}; correct it or remove the line")
        return settings

    def save(self, settings: Settings) -> None:
        """Write them."""
        values = {f.name: getattr(settings, f.name) for f in fields(Settings)}
        write_file(self.folder / _SETTINGS, toml_table("# of pysim app", values))

    def change(self, **values: Any) -> Settings:
        """Some of them changed, and written."""
        settings = replace(self.settings(), **values)
        self.save(settings)
        return settings

    def values(self) -> dict[str, float]:
        """Parameters that differ from the model's own, in their units, as `--parameters` takes them."""
        path = self.folder / VALUES
        if not path.is_file():
            return {}
        found = read_toml(path, VALUES, "write lines NAME = VALUE").whole.values
        if not all(isinstance(value, int | float) for value in found.values()):
            raise BadInput(f"{path}: a value is no number; write lines NAME = VALUE, or remove the file")
        return {name: float(value) for name, value in found.items()}

    def set_values(self, values: Mapping[str, float]) -> None:
        """Write them; none at all leaves no file."""
        if values:
            write_file(self.folder / VALUES, toml_table("# of pysim app", {toml_key(k): v for k, v in values.items()}))
        else:
            (self.folder / VALUES).unlink(missing_ok=True)

    def purge(self) -> None:
        """Remove results that were deleted: what could bring them back is gone with the server before."""
        gone = self.settings().deleted
        for folder in (self.folder / "results").glob("*") if gone else ():
            if folder.name in gone:
                shutil.rmtree(folder, ignore_errors=True)
        if gone:
            self.change(deleted=())

    def use_model(self, name: str, libraries: tuple[str, ...]) -> None:
        """Another model, with its own values and nothing added; or the same one, of libraries that may be others."""
        if name != self.settings().model:
            self.set_values({})
            self.change(free=(), bounds=(), added=())
        self.change(model=name, libraries=libraries)

    def model_name(self, name: str) -> str:
        """What the settings call the model that a user names: `Pump.fmu` may lie below `model/`."""
        name = name.strip()
        below = self.models / name
        bare = name.lower().endswith(".fmu") and not (self.folder / name).is_file() and below.is_file()
        return below.relative_to(self.folder).as_posix() if bare else name

    def fingerprint(self) -> str:
        """Of all that a result depends on: data, model, what may be refitted, and from which values."""
        settings = self.settings()
        fitted = sorted(settings.free), sorted(settings.bounds)  # in whatever order they were ticked
        chosen = (settings.model, settings.libraries, *fitted, *sorted(self.values().items()))
        return hashlib.sha256(repr((chosen, self.files())).encode()).hexdigest()

    def files(self) -> str:
        """Of data, model and libraries, by their bytes: what comes back as it was is the same. Of the description by
        what it says."""
        digest = hashlib.sha256()
        for name, path in (*_below(self.data), *_below(self.models), *self._elsewhere(self.settings())):
            stat = path.stat()
            read = _said if path == self.description else _bytes
            digest.update(repr((name, read(path, stat.st_mtime_ns, stat.st_size))).encode())
        return digest.hexdigest()

    def _elsewhere(self, settings: Settings) -> Iterator[tuple[str, Path]]:
        """Files of the model and the libraries that are neither below `data` nor below `model`, with their names."""
        seen = [self.data.resolve(), self.models.resolve()]
        model, libraries = self.folder / settings.model, [self.folder / name for name in settings.libraries]
        for place in [model, *libraries] if os.path.isfile(model) else libraries:  # a class may be no path at all
            place = place.resolve()
            if any(place.is_relative_to(folder) for folder in seen):
                continue
            yield from [(place.name, place)] if place.is_file() else self._foreign(place)

    def _foreign(self, library: Path) -> list[tuple[str, Path]]:
        """Files of a library, without what is hidden, as .git, and, where the project lies in it, the project's own."""
        project = self.folder.resolve()
        own = [project / name for name in _OWN] if project.is_relative_to(library) else []
        seen = ((name, path) for name, path in _below(library) if "/." not in f"/{name}")
        return [(name, path) for name, path in seen if not any(path.is_relative_to(place) for place in own)]

    def replace_data(self, folder: Path | None) -> str:
        """Take a folder's content as the data set, or none; what was there before is kept below `earlier`.

        Returns:
            where that is, in the project; "" where nothing was there.
        Raises:
            BadInput: a file that another program has open; all is as it was.
        """
        place = self._earlier("data") if self.data.exists() else None
        before = [] if place is None else [(self.data, place)]
        move_all([*before, *([] if folder is None else [(folder, self.data)])])
        return self._told(place)

    def earlier_data(self) -> list[Path]:
        """Data sets, or logs that were described later, in whose place others came; the last one first."""
        found = [path for path in (self.folder / "earlier").glob("data-*") if path.name.removeprefix("data-").isdigit()]
        return sorted(found, key=lambda path: -int(path.name.rpartition("-")[2]))

    def replace_models(self, paths: Sequence[Path]) -> str:
        """Take files and folders, each of another name, into `model`, as `replace_data` takes data."""
        self.models.mkdir(exist_ok=True)
        old = [self.models / path.name for path in paths if (self.models / path.name).exists()]
        place = self._earlier("model") if old else None
        before = [] if place is None else [(path, place / path.name) for path in old]
        if place is not None:
            place.mkdir()
        try:
            move_all([*before, *((path, self.models / path.name) for path in paths)])
        except BadInput:
            if place is not None:
                with contextlib.suppress(OSError):  # not where something could not go back
                    place.rmdir()
            raise
        return self._told(place)

    def _told(self, place: Path | None) -> str:
        """Where it is, seen from the project."""
        return "" if place is None else place.relative_to(self.folder).as_posix()

    def _earlier(self, kind: str) -> Path:
        """A new place below `earlier`, numbered on from the highest: the user may have removed any of them."""
        earlier = self.folder / "earlier"
        earlier.mkdir(exist_ok=True)
        found = (re.fullmatch(rf"{kind}-(\d+)", path.name) for path in earlier.iterdir())
        return earlier / f"{kind}-{1 + max((int(one[1]) for one in found if one), default=0)}"


@cache  # of every file: a bounded one would forget each before it is asked for again where there are more
def _bytes(path: Path, _modified: int, _size: int) -> str:
    """A digest of a file, read once per change of it."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


@lru_cache(maxsize=8)
def _said(path: Path, _modified: int, _size: int) -> str:
    """What a dataset.toml says that results depend on, in whatever order and words; its text where it is none."""
    try:
        content = read_toml(path, path.name).whole.values
        for signal in content["signals"].values():
            signal.pop("quantity", None)
        for record in content["records"]:
            record["use"] = record.get("use", "fit")
    except (BadInput, KeyError, AttributeError, TypeError):
        return repr(path.read_bytes())
    return json.dumps(content, sort_keys=True, default=str)


def _below(root: Path) -> list[tuple[str, Path]]:
    """Every file of a folder with its name seen from there, in order."""
    paths = sorted(root.rglob("*")) if root.is_dir() else ()
    return [(path.relative_to(root).as_posix(), path) for path in paths if path.is_file()]
