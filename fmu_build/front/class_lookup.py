"""Modelica's name lookup among the classes of libraries and files: enclosing classes, bases and imports."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from fmu_build.errors import BuildError
from fmu_build.front.declarations import ClassText, Declaration, Kind, SourceFile, read_declarations
from fmu_build.front.source import file_in_library, read_text


@dataclass(frozen=True)
class FoundClass:
    full_name: str
    source: SourceFile
    text: ClassText

    def error(self, message: str, offset: int) -> BuildError:
        return BuildError(message, self.source.file, self.source.line(offset))

    def of_kind(self, kind: Kind) -> Iterator[Declaration]:
        return (declaration for declaration in self.text.declarations if declaration.kind is kind)


class ClassLookup:
    """Each file is read once, each name looked up once."""

    def __init__(self, libraries: Sequence[Path]) -> None:
        self.libraries = libraries
        self._files: dict[Path, SourceFile] = {}
        self._by_full_name: dict[str, FoundClass | None] = {}
        self._resolved: dict[tuple[str, str], FoundClass | None] = {}
        self._in_bases_of: set[str] = set()  # guards against a base that is looked up in its own bases

    def full(self, name: str) -> FoundClass | None:
        """The class of this full name as written, without what its enclosing classes inherit."""
        if name not in self._by_full_name:
            self._by_full_name[name] = self._read(name)
        return self._by_full_name[name]

    def resolve(self, name: str, scope: FoundClass) -> FoundClass | None:
        """The class that `name` means inside `scope`; None for predefined types and for what is not found."""
        key = (name, scope.full_name)
        if key in self._resolved:
            return self._resolved[key]
        found = self._follow(name, scope)
        if not self._in_bases_of:
            self._resolved[key] = found
        return found

    def elements(self, name: str, owner: FoundClass) -> Iterator[tuple[FoundClass, Declaration]]:
        """The declarations of `name` in `owner` and then in its bases, each with the class that it stands in."""
        seen = set()
        waiting = [owner]
        while waiting:
            here = waiting.pop(0)
            if here.full_name not in seen:
                seen.add(here.full_name)
                yield from ((here, element) for element in here.text.declarations if name in element.declared)
                bases = (self.resolve(base.class_name, here) for base in here.of_kind(Kind.EXTENDS))
                waiting += [base for base in bases if base is not None]

    def _follow(self, name: str, scope: FoundClass) -> FoundClass | None:
        first, *rest = split_name(name.removeprefix("."))
        found = self.full(first) if name.startswith(".") else self._first(first, scope)
        for part in rest:
            found = self._member(found, part) if found is not None else None
        return found

    def _first(self, name: str, scope: FoundClass) -> FoundClass | None:
        """The first part of a name: from the scope outwards."""
        enclosing = split_name(scope.full_name)
        for count in range(len(enclosing), 0, -1):
            here = self.full(".".join(enclosing[:count]))
            found = here and (self._member(here, name) or self._imported(here, name))
            if found:
                return found
        return self.full(name)

    def _member(self, owner: FoundClass, name: str) -> FoundClass | None:
        """A class declared in `owner` or in one of its bases."""
        found = self.full(f"{owner.full_name}.{name}")
        if found is not None or owner.full_name in self._in_bases_of:
            return found
        self._in_bases_of.add(owner.full_name)
        try:
            for base in owner.of_kind(Kind.EXTENDS):
                used = self.resolve(base.class_name, owner)
                found = self._member(used, name) if used is not None else None
                if found is not None:
                    return found
        finally:
            self._in_bases_of.discard(owner.full_name)
        return None

    def _imported(self, owner: FoundClass, name: str) -> FoundClass | None:
        for declaration in owner.of_kind(Kind.IMPORT):
            full_name = declaration.class_name
            if declaration.declared == ("*",):
                full_name = f"{full_name}.{name}"
            elif declaration.declared != (name,):
                continue
            found = self._follow(f".{full_name}", owner)
            if found is not None:
                return found
        return None

    def _read(self, name: str) -> FoundClass | None:
        parts = split_name(name)
        for library in self.libraries:
            if library.is_dir() and library.name == parts[0]:
                file, inside = file_in_library(library, parts[1:])
            elif library.is_file():
                file, inside = library, parts
            else:
                continue
            found = self._inside(name, file, inside)
            if found is not None:
                return found
        return None

    def _inside(self, name: str, file: Path, path: list[str]) -> FoundClass | None:
        if file not in self._files:
            self._files[file] = read_declarations(file, read_text(file))
        classes = self._files[file].classes
        text = None
        for part in path:
            text = classes.get(part)
            if text is None:
                return None
            classes = text.classes
        return FoundClass(name, self._files[file], text) if text is not None else None


def split_name(name: str) -> list[str]:
    """`A.'b.c'.D` -> A, 'b.c', D."""
    parts: list[str] = []
    for piece in name.split("."):
        if parts and parts[-1].startswith("'") and (len(parts[-1]) == 1 or not parts[-1].endswith("'")):
            parts[-1] += f".{piece}"
        else:
            parts.append(piece)
    return parts
