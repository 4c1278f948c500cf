"""Libraries on disk: where their files are, and what stands in them."""

from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from pathlib import Path

from fmu_build.text.classes import ClassText, read_classes
from fmu_build.text.declarations import Source
from fmu_build.text.tokens import TextError

BUNDLED_LIBRARY = "HydraulicTestBench"


def bundled_library() -> Path:
    """The folder of our own Modelica library: beside this package in a clone, inside it where it is installed."""
    package = Path(__file__).resolve().parents[1]
    inside = package / "modelica" / BUNDLED_LIBRARY
    return inside if inside.is_dir() else package.parent / "modelica" / BUNDLED_LIBRARY


def check_place(place: Path) -> None:
    """Refuse what is no library: neither a folder with a package.mo nor a .mo file. Raises TextError."""
    if not place.exists():
        raise TextError(f"library {place} does not exist; give a folder with a package.mo, or a .mo file")
    is_library = (place / "package.mo").is_file() if place.is_dir() else place.suffix == ".mo"
    if not is_library:
        raise TextError(f"{place} is no Modelica library; give a folder with a package.mo, or a .mo file")


def files_of(place: Path) -> Iterator[tuple[Path, str]]:
    """Files of a library, each with the full name of the package around it.

    Raises:
        TextError: it is no library, or its folder is called other than its package.
    """
    check_place(place)
    if place.is_file():
        yield place, ""
        return
    called = package_name(place)
    if called != place.name:
        raise TextError(f"the package in {place} is called {called}; rename the folder to {called}")
    for file in sorted(place.rglob("*.mo")):
        inside = file.relative_to(place.parent).parent.parts
        yield file, ".".join(inside[:-1] if file.name == "package.mo" else inside)


def package_name(folder: Path) -> str:
    """What a library's package.mo calls itself, which its folder may not; "" where that cannot be read."""
    return next(iter(read_file(folder / "package.mo")), "")


def file_of(library: Path, parts: Sequence[str]) -> tuple[Path, Sequence[str], str]:
    """Where in a folder `library` the class is whose name goes on with `parts`.

    Returns:
        its file, the names to follow inside it, and the full name of the package around the file.
    """
    folder, outer = library, [library.name]
    for depth, part in enumerate(parts):
        if (folder / part / "package.mo").is_file():
            folder, outer = folder / part, [*outer, part]
        elif (folder / f"{part}.mo").is_file():
            return folder / f"{part}.mo", parts[depth:], ".".join(outer)
        else:
            return folder / "package.mo", [folder.name, *parts[depth:]], ".".join(outer[:-1])
    return folder / "package.mo", [folder.name], ".".join(outer[:-1])


def read_file(file: Path, outer: str = "") -> Mapping[str, ClassText]:
    """The classes of a file by name; parsed again only when its text has changed.

    Args:
        outer: full name of the package around it.
    Raises:
        TextError: it cannot be read, or says that it belongs to another package.
    """
    return _classes(file, read_text(file), outer)


@lru_cache(maxsize=4096)
def _classes(file: Path, text: str, outer: str) -> Mapping[str, ClassText]:
    return read_classes(Source(file, text), outer)


def read_text(file: Path) -> str:
    """Modelica text, which is UTF-8 by its specification, with or without a byte order mark.

    Raises:
        TextError: it cannot be read, or is in another encoding, with the line.
    """
    if file.is_fifo() or file.is_char_device():
        raise TextError("is a pipe or a device, which may never end; write it into a file", file)
    try:
        raw = file.read_bytes()
    except OSError as failure:
        raise TextError(f"cannot be read: {failure.strerror or failure}", file) from None
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as failure:
        line = raw.count(b"\n", 0, failure.start) + 1
        shown = raw[failure.start : failure.start + 1].decode("latin-1")
        message = f"{shown!r} is in another encoding than UTF-8, in which Modelica is written; save the file as UTF-8"
        raise TextError(message, file, line) from None
    return text.replace("\r\n", "\n").replace("\r", "\n")
