"""Write a file whole or not at all."""

from __future__ import annotations

import os
import uuid
from pathlib import Path


def write_file(path: Path, content: bytes | str) -> None:
    """Write beside the target and rename, so that nobody ever sees half a file; text becomes UTF-8.

    A target that is no regular file, such as /dev/null, is written to as it is.

    Raises:
        OSError: the place cannot be written, or another program has the file open (on Windows); what was there before
            is still there.
    """
    data = content.encode() if isinstance(content, str) else content
    path = path.resolve()
    if path.exists() and not path.is_file():
        path.write_bytes(data)
        return
    partial = path.with_name(f"{path.name}.{uuid.uuid4().hex[:8]}.part")
    try:
        partial.write_bytes(data)
        _replace(partial, path)
    finally:
        partial.unlink(missing_ok=True)


def _replace(partial: Path, path: Path) -> None:
    try:
        os.replace(partial, path)
    except PermissionError as error:
        if not path.exists():
            raise
        cure = "cannot be replaced; close the program that shows it, or allow writing to it"
        raise PermissionError(error.errno, cure, str(path)) from error
