"""Libraries on disk: their classes by full name, and what a name means inside one of them."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property, lru_cache
from pathlib import Path

from pysim.effects._classes import ClassText, read_classes
from pysim.types import BadInput


class Libraries:
    """Every class of some libraries, each a folder with a package.mo or a single .mo file."""

    def __init__(self, places: Sequence[Path]) -> None:
        self._places = [Path(place) for place in places]

    @cached_property
    def classes(self) -> dict[str, ClassText]:
        """Full name -> class, in the order of the files."""
        found: dict[str, ClassText] = {}
        for place in self._places:
            for file, within in _files(place):
                stat = file.stat()
                for text in _classes_of(file, within, stat.st_mtime_ns, stat.st_size):
                    found.setdefault(text.full_name, text)
        return found

    def resolve(self, name: str, scope: str) -> ClassText | None:
        """The class that `name` means inside the class `scope`; None where it is in none of the libraries."""
        if name.startswith("."):
            return self.classes.get(name[1:])
        parts = scope.split(".")
        for count in range(len(parts), -1, -1):
            found = self.classes.get(".".join([*parts[:count], name]))
            if found is not None:
                return found
        return None


def _files(place: Path) -> list[tuple[Path, str]]:
    """Files of a library, each with the full name of the package around it."""
    if place.is_file() and place.suffix == ".mo":
        return [(place, "")]
    if not (place / "package.mo").is_file():
        raise BadInput(f"{place} is no Modelica library; give a folder with a package.mo, or a .mo file")
    files = []
    for file in sorted(place.rglob("*.mo")):
        inside = file.relative_to(place.parent).parent.parts
        inside = inside[:-1] if file.name == "package.mo" else inside
        files.append((file, ".".join(inside)))
    return files


@lru_cache(maxsize=4096)
def _classes_of(file: Path, within: str, changed: int, size: int) -> tuple[ClassText, ...]:
    """Classes of one file; read again only when it has changed. Nobody changes them once they are read."""
    try:
        return tuple(read_classes(file.read_text(encoding="utf-8-sig"), file, within))
    except (OSError, UnicodeDecodeError) as error:
        raise BadInput(f"{file}: cannot be read ({error}); save it as UTF-8 text") from error
