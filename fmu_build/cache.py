"""Finished FMUs kept by the content they were made from, so that an unchanged model is not built twice."""

import hashlib
import os
import shutil
import sys
import time
import uuid
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from fmu_build.errors import BuildError

FOLDER_VARIABLE = "HTB_CACHE"
KEPT_FMUS = 200
IN_USE = 86400.0  # s since its last use for which an FMU stays, however many there are: a run may still read it
_TOOLS = ("rumoca", "casadi", "ziglang", "fmpy")  # their versions shape the result
_OWN_SUFFIXES = {".py", ".c", ".h", ".txt"}


def cache_folder() -> Path:
    """$HTB_CACHE, else the place this system has for such files."""
    given = os.environ.get(FOLDER_VARIABLE)
    if given:
        return Path(given)
    home = Path.home()
    if sys.platform == "win32":
        base = Path(os.environ.get("LOCALAPPDATA") or home / "AppData" / "Local")
    elif sys.platform == "darwin":
        base = home / "Library" / "Caches"
    else:
        base = Path(os.environ.get("XDG_CACHE_HOME") or home / ".cache")
    return base / "hydraulic-test-bench" / "fmu"


def content_key(
    class_name: str, libraries: Sequence[Path], overrides: Mapping[str, float | str], options: Sequence[str]
) -> str:
    """A digest of everything the FMU depends on: Modelica text, values, options, our code and our tools."""
    digest = hashlib.sha256()
    _add(digest, class_name, repr(sorted(overrides.items())), repr(list(options)), sys.version)
    _add(digest, *(_version(tool) for tool in _TOOLS))
    package = Path(__file__).parent
    _add_files(digest, package, (path for path in package.rglob("*") if path.suffix in _OWN_SUFFIXES))
    for library in libraries:
        files = library.rglob("*") if library.is_dir() else [library]
        _add_files(digest, library, (p for p in files if p.suffix in (".mo", ".mos") or p.name == "package.order"))
    return digest.hexdigest()


def cached(key: str) -> Path | None:
    """The FMU made from this content, marked as used just now; None where there is none."""
    path = _place(key)
    with suppress(OSError):
        os.utime(path)
        return path
    return None


def store(key: str, fmu: Path) -> Path:
    """Keep a copy of a new FMU and let go of those unused for longest, but of none that a run may still read."""
    target = _place(key)
    try:
        copy_whole(fmu, target)
    except OSError as error:
        raise BuildError(
            f"cannot keep the FMU in {target.parent}: {error.strerror or error}; "
            f"name another folder in the environment variable {FOLDER_VARIABLE}."
        ) from error
    _tidy(target.parent)
    return target


def _tidy(folder: Path) -> None:
    """Another process may be at the same: a file that is gone, or still open elsewhere, is passed over."""
    used: dict[Path, float] = {}
    for path in folder.glob("*.fmu"):
        with suppress(OSError):
            used[path] = path.stat().st_mtime
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


def _place(key: str) -> Path:
    return cache_folder() / f"{key}.fmu"


def _version(package: str) -> str:
    try:
        return f"{package} {version(package)}"
    except PackageNotFoundError:
        return f"{package} absent"


def _add(digest: "hashlib._Hash", *texts: str) -> None:
    for text in texts:
        data = text.encode()
        digest.update(f"{len(data)}\0".encode() + data)


def _add_files(digest: "hashlib._Hash", root: Path, files: Iterable[Path]) -> None:
    """Name and content of each; the root's own place does not matter."""
    for path in sorted(files):
        _add(digest, path.relative_to(root).as_posix())
        data = path.read_bytes()
        digest.update(f"{len(data)}\0".encode() + data)
