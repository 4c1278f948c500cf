"""A zip file that depends on its content alone."""

import os
import tempfile
import uuid
import zipfile
from collections.abc import Callable, Mapping
from pathlib import Path

from fmu_build.errors import BuildError

_EARLIEST = (1980, 1, 1, 0, 0, 0)  # the first time a zip file can state
_UNIX = 3
_FILE_MODE = 0o100644 << 16


def write_archive(output: Path, members: Mapping[str, bytes], check: Callable[[Path], None]) -> None:
    """Write `members` (path inside: content) to `output`, by way of a file beside it that `check` must accept.

    `output` appears whole or not at all. Raises BuildError where it cannot be written, and what `check` raises.
    """
    temporary = output.with_name(f".{output.stem}-{uuid.uuid4().hex}.fmu")
    try:
        with temporary.open("xb") as file, zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
            for path in sorted(members, key=lambda path: (path != "modelDescription.xml", path)):
                archive.writestr(_entry(path), members[path])
        check(temporary)
        os.replace(temporary, output)
    except OSError as error:
        raise _unwritable(output, error) from error
    finally:
        temporary.unlink(missing_ok=True)


def check_writable(output: Path) -> None:
    """Refuse a target that cannot be written, before any work is spent on it."""
    if output.is_dir():
        raise BuildError(f"cannot write {output}: it is a folder; name a file.")
    if not output.parent.is_dir():
        raise BuildError(f"cannot write {output}: the folder {output.parent} does not exist; create it first.")
    try:
        with tempfile.TemporaryFile(dir=output.parent):
            pass
    except OSError as error:
        raise _unwritable(output, error) from error


def _unwritable(output: Path, error: OSError) -> BuildError:
    return BuildError(f"cannot write {output}: {error.strerror or error}; choose another place.")


def _entry(path: str) -> zipfile.ZipInfo:
    entry = zipfile.ZipInfo(path, _EARLIEST)
    entry.compress_type = zipfile.ZIP_DEFLATED
    entry.create_system = _UNIX
    entry.external_attr = _FILE_MODE
    return entry
