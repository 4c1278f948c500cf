"""Whether an FMU or an SSP package may be unpacked: by its directory, before anything of it is read."""

from __future__ import annotations

import zipfile
import zlib
from dataclasses import dataclass
from pathlib import Path, PurePosixPath, PureWindowsPath

from pysim.types import BadInput, setting

# What zipfile raises for a damaged archive, for a compression it does not know, and for one with a password
DAMAGED = (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, RuntimeError)

_METHODS = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)


@dataclass(frozen=True)
class ArchiveLimits:
    """How much an archive may unpack to."""

    files: int = setting(
        10_000,
        unit="files",
        meaning="files and folders in the archive",
        source="the secure example of Sonar's rule S5042 (archives and resource consumption)",
    )
    size: int = setting(
        1_000_000_000,
        unit="bytes",
        meaning="sum of the unpacked files",
        source="the same",
    )
    ratio: float = setting(
        100.0,
        unit="1",
        meaning="that sum over the size of the archive",
        source="text of honest FMUs shrinks to a twentieth; Deflate reaches 1032 (zlib, Technical Details)",
    )
    small: int = setting(
        20_000_000,
        unit="bytes",
        meaning="sum of the unpacked files up to which the ratio does not matter",
        source="no computer is harmed by it",
    )


LIMITS = ArchiveLimits()


def check_archive(path: Path, limits: ArchiveLimits = LIMITS) -> dict[str, zipfile.ZipInfo]:
    """Refuse an archive that would fill the disk, or write outside its folder. No member is read.

    zipfile gives out no more of a member than the directory says, and raises BadZipFile where the member has more; so
    a directory that lies about a size is found while the member is read, and the sum of the sizes is a bound.

    Returns:
        The members by name, as zipfile finds them: of several with one name the last.
    Raises:
        BadInput: too many files, too large, a name that leaves the folder, or a compression that FMI does not allow.
        *DAMAGED, OSError: no zip archive, or a damaged one.
    """
    with zipfile.ZipFile(path) as archive:
        members = archive.infolist()
    total = sum(member.file_size for member in members)
    allowed = min(limits.size, max(limits.small, limits.ratio * path.stat().st_size))
    if len(members) > limits.files:
        raise BadInput(f"{path} holds {len(members)} files, more than {limits.files}; export it again with fewer")
    if total > allowed:
        raise BadInput(
            f"{path} would unpack to {total / 1e6:.0f} MB, more than the {allowed / 1e6:.0f} MB that an archive of its "
            "size may; export it again without the files that fill it, or do not use it"
        )
    for member in members:
        _check_member(path, member)
    return {member.filename: member for member in members}


def _check_member(path: Path, member: zipfile.ZipInfo) -> None:
    """Refuse names that leave the folder, by the rules of either family of systems."""
    name = member.filename
    parts = PurePosixPath(name.replace("\\", "/"))
    if not parts.parts or parts.is_absolute() or ".." in parts.parts or PureWindowsPath(name).drive:
        raise BadInput(f"{path} holds a file named {name!r}, which would be written outside its folder: do not use it")
    if member.compress_type not in _METHODS:  # FMI 3.0, section 2.5; others expand further than was asked for
        raise BadInput(f"{path}: {name} is not compressed by Deflate, as FMI asks for; pack the archive again")
