"""Finished FMUs kept by the content they were made from, so that an unchanged model is not built twice.

An FMU is loaded as code, so it is given out only from a folder that no other user could have written into, and only as
long as it has the digest in its name. What the compilers keep becomes part of an FMU, so it lies in such a folder too.
"""

import hashlib
import os
import shutil
import sys
import time
import uuid
from collections.abc import Mapping, Sequence
from contextlib import suppress
from functools import cache, lru_cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from fmu_build.errors import BuildError
from fmu_build.private_folder import ANOTHER, UnusableFolder, private_folder

KEPT_FMUS = 200
IN_USE = 86400.0  # s since its last use for which an FMU stays, however many there are: a run may still read it
_SETTLED = 2.0  # s since a file's last change from when a further one changes its time too: FAT counts in steps of 2 s
_TOOLS = ("rumoca", "casadi", "ziglang", "fmpy")  # their versions shape the result
_OWN_FILES = (".py", ".c", ".h", ".txt")  # how their names end
_MODELICA_FILES = (".mo", ".mos", "package.order")


def cache_folder(purpose: str = "fmu") -> Path:
    """The folder of finished FMUs, or for what a compiler keeps, see `private_folder`.

    Raises:
        BuildError: it cannot be written, belongs to another user, or others may write into it.
    """
    try:
        return private_folder(purpose)
    except UnusableFolder as error:
        raise BuildError(f"{error}.") from error


def content_key(
    class_name: str, libraries: Sequence[Path], overrides: Mapping[str, float | str], options: Sequence[str]
) -> str:
    """A digest of everything the FMU depends on: Modelica text, values, options, our code and our tools."""
    digest = hashlib.sha256()
    _add(digest, class_name, repr(sorted(overrides.items())), repr(list(options)), sys.version)
    _add(digest, *(_version(tool) for tool in _TOOLS))
    _add_files(digest, Path(__file__).parent, _OWN_FILES)
    for library in libraries:
        _add_files(digest, library, _MODELICA_FILES)
    return digest.hexdigest()


def cached(key: str) -> Path | None:
    """The FMU made from this content, marked as used just now; None where there is none.

    Raises:
        BuildError: it is not what was stored, or the folder is not this user's alone.
    """
    for path in cache_folder().glob(f"{key}-*.fmu"):
        with suppress(FileNotFoundError):  # another process has let go of it
            if path != _place(key, path):
                raise BuildError(f"{path} was changed after it was built; delete it and build again.")
            with suppress(OSError):  # Windows: another process has it open
                os.utime(path, ns=(time.time_ns(), path.stat().st_mtime_ns))  # who has read it sees it unchanged
            return path
    return None


def store(key: str, fmu: Path) -> Path:
    """Keep a copy of a new FMU and let go of those unused for longest, but of none that a run may still read."""
    target = _place(key, fmu)
    try:
        copy_whole(fmu, target)
    except OSError as error:
        raise _unwritable(target.parent, error) from error
    _tidy(target.parent)
    return target


def _tidy(folder: Path) -> None:
    """Another process may be at the same: a file that is gone, or still open elsewhere, is passed over."""
    used: dict[Path, float] = {}
    for path in folder.glob("*.fmu"):
        with suppress(OSError):
            used[path] = path.stat().st_atime
    lately = time.time() - IN_USE
    for path in sorted(used, key=used.__getitem__, reverse=True)[KEPT_FMUS:]:
        if used[path] < lately:
            with suppress(OSError):
                path.unlink()


def copy_whole(source: Path, target: Path) -> None:
    """Copy a file so that `target` never exists in part. Raises OSError."""
    target.parent.mkdir(parents=True, exist_ok=True)
    temporary = target.with_name(f".{target.stem}-{uuid.uuid4().hex}.tmp")
    try:
        shutil.copyfile(source, temporary)
        os.replace(temporary, target)
    finally:
        temporary.unlink(missing_ok=True)


def _place(key: str, fmu: Path) -> Path:
    """Where an FMU made from the content of `key` is kept: its own digest is part of the name."""
    return cache_folder() / f"{key}-{hashlib.sha256(fmu.read_bytes()).hexdigest()[:32]}.fmu"


def _unwritable(folder: Path, error: OSError) -> BuildError:
    return BuildError(f"cannot keep what is built in {folder}: {error.strerror or error}; {ANOTHER}.")


@cache
def _version(package: str) -> str:
    try:
        return f"{package} {version(package)}"
    except PackageNotFoundError:
        return f"{package} absent"


def _add(digest: "hashlib._Hash", *texts: str) -> None:
    for text in texts:
        data = text.encode()
        digest.update(f"{len(data)}\0".encode() + data)


def _add_files(digest: "hashlib._Hash", root: Path, ends: tuple[str, ...]) -> None:
    """Name and content of a file, or of each below a folder whose name ends so; the place of `root` does not matter."""
    top = str(root)
    found = [(".", top)] if root.is_file() else []
    for folder, _, names in os.walk(top):
        found += [(os.path.join(folder, name)[len(top) :], os.path.join(folder, name)) for name in names]
    for name, file in sorted(found):
        if file.endswith(ends):
            _add(digest, name.replace(os.sep, "/"))
            digest.update(_file_digest(file))


def _file_digest(file: str) -> bytes:
    """SHA-256 of a file; read once in a process as long as its time and size stay the same."""
    known = os.stat(file)
    changed = max(known.st_mtime_ns, known.st_ctime_ns)
    if abs(time.time() - changed / 1e9) < _SETTLED:
        return _read_digest(file)
    return _kept_digest(file, changed, known.st_size)


@lru_cache(maxsize=4096)
def _kept_digest(file: str, _changed: int, _size: int) -> bytes:
    return _read_digest(file)


def _read_digest(file: str) -> bytes:
    return hashlib.sha256(Path(file).read_bytes()).digest()
