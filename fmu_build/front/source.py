"""Finds a class in libraries and files, and reads its annotations, which rumoca does not pass on."""

import difflib
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from fmu_build.errors import BuildError
from fmu_build.front.declarations import CLASS_KINDS, read_declarations
from fmu_build.front.expression import Span
from fmu_build.front.flat_model import Experiment


@dataclass(frozen=True)
class ClassSource:
    """Where a class is written; `is_single_file` where its file is no part of a library directory."""

    name: str
    file: Path
    line: int
    text: str
    is_single_file: bool
    description: str
    annotation: tuple[str, ...]  # tokens between the annotation's parentheses

    @property
    def span(self) -> Span:
        return Span(self.file, self.line)

    @property
    def experiment(self) -> Experiment:
        values = _named_numbers(_call_arguments(self.annotation, "experiment"))
        return Experiment(
            start=values.get("StartTime"),
            stop=values.get("StopTime"),
            tolerance=values.get("Tolerance"),
            interval=values.get("Interval"),
        )

    @property
    def documentation(self) -> str:
        """HTML of the Documentation annotation, empty where there is none."""
        tokens = _call_arguments(self.annotation, "Documentation")
        for at, token in enumerate(tokens[:-2]):
            if token == "info" and tokens[at + 1] == "=":
                return "".join(_text(part) for part in tokens[at + 2 :] if part.startswith('"'))
        return ""


def find_class(name: str, libraries: Sequence[Path]) -> ClassSource:
    """Look the class up by its full name.

    Raises:
        BuildError: no library holds it.
    """
    parts = name.split(".")
    for library in libraries:
        if not library.exists():
            raise BuildError(f"library {library} does not exist")
        if library.is_dir() and not (library / "package.mo").is_file():
            raise BuildError(f"{library} is no Modelica library: it has no package.mo")
        if library.is_dir() and library.name == parts[0]:
            file, inside = file_in_library(library, parts[1:])
            return _read(name, file, inside or [parts[-1]], False)
        if library.is_file() and _declared(parts[0]).search(read_text(library)):
            return _read(name, library, parts, True)
    where = ", ".join(dict.fromkeys(str(library) for library in libraries)) or "no library"
    called = [library for library in libraries if library.is_dir() and _package(library) == parts[0]]
    cure = f"rename the folder to {parts[0]}, as its package is called" if called else ""
    cure = cure or "give its full name, and its library or file"
    raise BuildError(f"class {name} is not in {where}; {cure}")


def _package(library: Path) -> str:
    """What a library's package.mo calls itself, which its folder may not."""
    return next(iter(read_declarations(library / "package.mo", read_text(library / "package.mo")).classes), "")


def file_in_library(library: Path, parts: list[str]) -> tuple[Path, list[str]]:
    """The file that holds the class, and the names to follow inside it."""
    folder = library
    for depth, part in enumerate(parts):
        if (folder / part / "package.mo").is_file():
            folder = folder / part
        elif (folder / f"{part}.mo").is_file():
            return folder / f"{part}.mo", parts[depth:]
        else:
            return folder / "package.mo", [folder.name, *parts[depth:]]
    return folder / "package.mo", [folder.name]


def read_text(file: Path) -> str:
    """Modelica text, which is UTF-8 by its specification, with or without a byte order mark.

    Raises:
        BuildError: it cannot be read, or is in another encoding, with the line.
    """
    try:
        raw = file.read_bytes()
    except OSError as failure:
        raise BuildError(f"cannot be read: {failure.strerror or failure}", file) from None
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as failure:
        line = raw.count(b"\n", 0, failure.start) + 1
        shown = raw[failure.start : failure.start + 1].decode("latin-1")
        message = f"{shown!r} is in another encoding than UTF-8, in which Modelica is written; save the file as UTF-8"
        raise BuildError(message, file, line) from None
    return text.replace("\r\n", "\n").replace("\r", "\n")


def _declared(name: str) -> re.Pattern[str]:
    return re.compile(rf"\b(?:{'|'.join(sorted(CLASS_KINDS))})\s+{re.escape(name)}\b")


def _read(name: str, file: Path, path: list[str], is_single_file: bool) -> ClassSource:
    text = read_text(file)
    source = read_declarations(file, text)
    classes, found = source.classes, None
    for part in path:
        found = classes.get(part)
        if found is None:
            break
        classes = found.classes
    if found is None:
        begin = _declared(path[-1]).search(text)
        if begin is None:
            near = _near(part, file, classes)
            hint = f"; near it: {', '.join(near)}" if near else ""
            raise BuildError(f"class {name} is not here: there is no {part}{hint}", file)
        line = text.count("\n", 0, begin.start()) + 1  # behind a syntax error, whose place rumoca will tell
        return ClassSource(name, file, line, text, is_single_file, "", ())
    description = "".join(_text(word) for word in found.words[:1] if word.startswith('"'))
    annotation = _own_annotation(found.words)
    return ClassSource(name, file, source.line(found.offset), text, is_single_file, description, annotation)


def _near(name: str, file: Path, classes: Iterable[str]) -> list[str]:
    """Classes that somebody may have meant: of this one, and where it is a package, the files and folders beside it."""
    names = set(classes)
    if file.name == "package.mo":
        names |= {f.stem for f in file.parent.glob("*.mo")} | {f.parent.name for f in file.parent.glob("*/package.mo")}
    small = {one.lower(): one for one in sorted(names - {"package"})}
    return [small[one] for one in difflib.get_close_matches(name.lower(), list(small), n=3)]


def _own_annotation(words: tuple[str, ...]) -> tuple[str, ...]:
    """Arguments of the last `annotation (...)` followed by nothing but the end of the class."""
    for at in range(len(words) - 1, -1, -1):
        if words[at] == "annotation":
            arguments = _call_arguments(words[at:], "annotation")
            rest = words[at + len(arguments) + 3 :]
            return arguments if rest in ((";",), ()) else ()
    return ()


def _call_arguments(tokens: tuple[str, ...], name: str) -> tuple[str, ...]:
    """Tokens between the parentheses after the first `name (`."""
    for at in range(len(tokens) - 1):
        if tokens[at] == name and tokens[at + 1] == "(":
            depth = 0
            for stop in range(at + 1, len(tokens)):
                depth += {"(": 1, ")": -1}.get(tokens[stop], 0)
                if depth == 0:
                    return tokens[at + 2 : stop]
    return ()


def _named_numbers(tokens: tuple[str, ...]) -> dict[str, float]:
    """`StopTime = 2, Tolerance = 1e-6` -> numbers by name; other values are left out."""
    numbers = {}
    for at in range(len(tokens) - 2):
        if tokens[at + 1] == "=":
            value = tokens[at + 2] if tokens[at + 2] not in "+-" else "".join(tokens[at + 2 : at + 4])
            try:
                numbers[tokens[at]] = float(value)
            except ValueError:
                continue
    return numbers


def _text(token: str) -> str:
    """A Modelica string without its quotes and escapes."""
    escapes = {"n": "\n", "t": "\t"}
    return re.sub(r"\\(.)", lambda match: escapes.get(match.group(1), match.group(1)), token[1:-1], flags=re.DOTALL)
