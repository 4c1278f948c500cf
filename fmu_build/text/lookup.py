"""Modelica's name lookup among the classes of libraries and files: enclosing classes, bases and imports."""

import difflib
import os
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import accumulate
from pathlib import Path

from fmu_build.text.classes import ClassText
from fmu_build.text.declarations import CLASS_KINDS, Declaration, Kind, Source
from fmu_build.text.libraries import check_place, file_of, files_of, package_name, read_file, read_text
from fmu_build.text.modify import redeclarations
from fmu_build.text.tokens import TextError, dotted_name, split_name


class Libraries:
    """Libraries and what names mean in them; each name is looked up once.

    Args:
        places: folders with a package.mo, or .mo files; a class in two of them is taken from the first.
    """

    def __init__(self, places: Sequence[Path]) -> None:
        self.places = list(dict.fromkeys(Path(place) for place in places))
        self._by_full_name: dict[str, ClassText | None] = {}
        self._resolved: dict[tuple[str, str], ClassText | None] = {}
        self._holding: dict[str, list[Path]] = {}
        self._listed: dict[Path, frozenset[str]] = {}
        self._in_bases_of: set[str] = set()  # guards against a base that is looked up in its own bases

    def classes(self, word: str = "") -> Iterator[ClassText]:
        """Every class, also those inside others, in the order of the files; only of files that hold a word, if given.

        Raises:
            TextError: a place is no library, or a file cannot be read.
        """
        for place in self.places:
            for file, outer in files_of(place):
                for one in _with_inner(read_file(file, outer).values() if word in read_text(file) else ()):
                    first = self.full(one.full_name)
                    if first is None or first.source.file == file:
                        yield one

    def find(self, name: str) -> ClassText:
        """The class of a full name; of one that cannot be read for a syntax error, only its place.

        Raises:
            TextError: no library holds it; says what is near.
        """
        parts = split_name(name)
        for place in self.places:
            check_place(place)
            if place.is_dir() and place.name == parts[0]:
                file, inside, outer = file_of(place, parts[1:])
            elif place.is_file() and _declared(parts[0]).search(read_text(place)):
                file, inside, outer = place, parts, ""
            else:
                continue
            return _inside(file, inside, outer) or _unread(name, file, inside, outer)
        where = ", ".join(dict.fromkeys(str(place) for place in self.places)) or "no library"
        called = [place for place in self.places if place.is_dir() and package_name(place) == parts[0]]
        cure = f"rename the folder to {parts[0]}, as its package is called" if called else ""
        near = difflib.get_close_matches(parts[0], [place.stem for place in self.places])
        cure = cure or (f"near it: {', '.join(near)}" if near else "")
        raise TextError(f"class {name} is not in {where}; {cure or 'give its full name, and its library or file'}")

    def full(self, name: str) -> ClassText | None:
        """The class of this full name as written, without what its enclosing classes inherit."""
        if name not in self._by_full_name:
            self._by_full_name[name] = self._read(name)
        return self._by_full_name[name]

    def resolve(self, name: str, scope: ClassText) -> ClassText | None:
        """The class that `name` means inside `scope`; None for predefined types and for what is not found."""
        key = (name, scope.full_name)
        if key in self._resolved:
            return self._resolved[key]
        found = self._follow(name, scope)
        if not self._in_bases_of:
            self._resolved[key] = found
        return found

    def ancestry(self, text: ClassText) -> Iterator[ClassText]:
        """The class, then all it extends, nearest first."""
        return self.reached(text, lambda one: (base.class_name for base in one.of_kind(Kind.EXTENDS)))

    def used(self, text: ClassText) -> Iterator[ClassText]:
        """The class, its bases, the classes of its parts, and those they are redeclared to."""

        def names(here: ClassText) -> Iterator[str]:
            for declaration in here.declarations:
                if is_use(declaration):
                    yield declaration.class_name
                    yield from (found.class_name for found in redeclarations(declaration.modification))

        return self.reached(text, names)

    def named(self, text: ClassText) -> Iterator[ClassText]:
        """The class, then all that a name in it may mean and the packages around it, and so on from each, each once."""

        def names(here: ClassText) -> Iterator[str]:
            yield here.full_name.rpartition(".")[0]
            for at in range(len(here.own_tokens)):
                yield from accumulate(split_name(dotted_name(here.own_tokens, at)[0]), "{}.{}".format)

        return self.reached(text, names)

    def reached(self, text: ClassText, names: Callable[[ClassText], Iterable[str]]) -> Iterator[ClassText]:
        """The class, then those that it names, and those that they name, each once."""
        seen, waiting = set(), [text]
        while waiting:
            here = waiting.pop(0)
            if here.full_name not in seen:
                seen.add(here.full_name)
                yield here
                waiting += [one for name in names(here) if name and (one := self.resolve(name, here)) is not None]

    def elements(self, name: str, owner: ClassText) -> Iterator[tuple[ClassText, Declaration]]:
        """The declarations of `name` in `owner` and then in its bases, each with the class that it stands in."""
        for here in self.ancestry(owner):
            yield from ((here, element) for element in here.declarations if element.name == name)

    def _follow(self, name: str, scope: ClassText) -> ClassText | None:
        first, *rest = split_name(name.removeprefix("."))
        found = self.full(first) if name.startswith(".") else self._first(first, scope)
        for part in rest:
            found = self._member(found, part) if found is not None else None
        return found

    def _first(self, name: str, scope: ClassText) -> ClassText | None:
        """The first part of a name: from the scope outwards."""
        enclosing = split_name(scope.full_name)
        for count in range(len(enclosing), 0, -1):
            here = self.full(".".join(enclosing[:count]))
            found = here and (self._member(here, name) or self._imported(here, name))
            if found:
                return found
        return self.full(name)

    def _member(self, owner: ClassText, name: str) -> ClassText | None:
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

    def _imported(self, owner: ClassText, name: str) -> ClassText | None:
        for declaration in owner.of_kind(Kind.IMPORT):
            behind = {"*": f".{name}", name: ""}.get(declaration.name)
            found = None if behind is None else self._follow(f".{declaration.class_name}{behind}", owner)
            if found is not None:
                return found
        return None

    def _read(self, name: str) -> ClassText | None:
        parts = split_name(name)
        around, places = self._by_full_name.get(name[: -len(parts[-1]) - 1]), self._places_of(parts[0])
        if len(places) == 1 and around is not None and not self._may_have_a_file(parts[-1], around.source.file):
            return around.classes.get(parts[-1])
        for place in places:
            found = _inside(*file_of(place, parts[1:])) if place.is_dir() else _inside(place, parts, "")
            if found is not None:
                return found
        return None

    def _places_of(self, first: str) -> list[Path]:
        """Where classes may stand whose full names begin so: a library of that name, and files that declare it."""
        if first not in self._holding:
            self._holding[first] = [
                place
                for place in self.places
                if (place.is_dir() and place.name == first) or (place.is_file() and first in read_file(place))
            ]
        return self._holding[first]

    def _may_have_a_file(self, name: str, around: Path) -> bool:
        """Whether a class may stand in a file or folder of its own, beside the file of the class around it."""
        folder = around.parent
        if around.name != "package.mo":
            return False
        if folder not in self._listed:
            self._listed[folder] = frozenset(os.listdir(folder))
        return not self._listed[folder].isdisjoint((name, f"{name}.mo"))


def is_use(declaration: Declaration) -> bool:
    """Whether an element brings the class that it names into the model."""
    return declaration.kind in (Kind.EXTENDS, Kind.COMPONENT) or "redeclare" in declaration.prefixes


def _inside(file: Path, path: Sequence[str], outer: str) -> ClassText | None:
    """The class at the end of a path of names inside a file."""
    classes, found = read_file(file, outer), None
    for part in path:
        found = classes.get(part)
        if found is None:
            return None
        classes = found.classes
    return found


def _with_inner(classes: Iterable[ClassText]) -> Iterator[ClassText]:
    for one in classes:
        yield one
        yield from _with_inner(one.classes.values())


def _declared(name: str) -> re.Pattern[str]:
    return re.compile(rf"\b({'|'.join(sorted(CLASS_KINDS))})\s+{re.escape(name)}\b")


def _unread(name: str, file: Path, path: Sequence[str], outer: str) -> ClassText:
    """A class that is not where it should be, unless it stands behind a syntax error, whose place a compiler tells."""
    text = read_text(file)
    begin = _declared(path[-1]).search(text)
    if begin is not None:
        return ClassText(name, path[-1], begin[1], frozenset(), begin.start(), Source(file, text))
    classes, part = read_file(file, outer), path[0]
    for part in path:
        if part not in classes:
            break
        classes = classes[part].classes
    near = _near(part, file, classes)
    hint = f"; near it: {', '.join(near)}" if near else ""
    raise TextError(f"class {name} is not here: there is no {part}{hint}", file)


def _near(name: str, file: Path, classes: Iterable[str]) -> list[str]:
    """Classes that somebody may have meant: of this one, and where it is a package, the files and folders beside it."""
    names = set(classes)
    if file.name == "package.mo":
        names |= {f.stem for f in file.parent.glob("*.mo")} | {f.parent.name for f in file.parent.glob("*/package.mo")}
    small = {one.lower(): one for one in sorted(names - {"package"})}
    return [small[one] for one in difflib.get_close_matches(name.lower(), list(small), n=3)]
