"""Runs rumoca: finds the class, compiles it, and turns every failure into one `BuildError` with a place."""

import os
import re
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from itertools import accumulate
from math import isfinite
from pathlib import Path
from typing import Any

from fmu_build.errors import BuildError
from fmu_build.front.joined import JoinedText, join
from fmu_build.front.source import ClassSource
from fmu_build.front.tokens import tokenise

WRAPPER = "OverridesOfThisBuild"
Override = float | str  # a number, or Modelica text
_NOISE = re.compile(r"^(?:[a-z]+ failed: )?(?:\S+ (?:could not be compiled|failed in \w+): )?")
PLACE = re.compile(r"\[([^\[\]\n]+?\.mo):(\d+):\d+\]")


def compile_class(
    source: ClassSource, libraries: Sequence[Path], overrides: Mapping[str, Override]
) -> tuple[dict[str, Any], dict[str, Any]]:
    """rumoca's DAE form and flat form of the class, with `overrides` as modifications.

    Raises:
        BuildError: the class cannot be compiled, or only without the overrides, which are then to blame.
    """
    modification = _modification(overrides)
    try:
        return _compile(source, libraries, modification)
    except BuildError as failure:
        if not overrides:
            raise
        _compile(source, libraries, "")  # where this fails too, the model is at fault
        raise BuildError(
            f"{source.name} does not compile with the values set, {modification}: {failure.message}"
        ) from None


def _compile(
    source: ClassSource, libraries: Sequence[Path], modification: str
) -> tuple[dict[str, Any], dict[str, Any]]:
    roots = [str(library) for library in libraries if library.is_dir()]
    joined = join(source, libraries)
    text = joined.text
    name = source.name
    if modification or not source.is_single_file:
        name = WRAPPER
        text += f"\nmodel {WRAPPER}\n  extends {source.name}{modification};\nend {WRAPPER};\n"
    file_name = _stand_in(source) if joined.parts else f"{WRAPPER}.mo"
    rumoca = _import_rumoca()
    with _quiet_stderr():
        try:
            model = rumoca.Session(roots=roots).loads(text, model=name, filename=file_name)
            dae, flat = model.to_dict("dae"), model.to_dict("flat")
        except BaseException as failure:  # a panic in rumoca is no Exception
            if isinstance(failure, KeyboardInterrupt | SystemExit):
                raise
            raise _explain(failure, source, joined, libraries, rumoca) from None
    for known in dae["source_map"]["files"]:  # [number, name, text]
        if known[1] == _stand_in(source):
            known[1] = joined
    return dae, flat


def _stand_in(source: ClassSource) -> str:
    """A name in a folder that does not exist: rumoca also reads all other .mo files of a real one."""
    return f"FolderOfThisBuild/{source.file.name}"


def _import_rumoca() -> Any:
    try:
        import rumoca
    except ImportError:
        raise BuildError(
            "building from Modelica needs rumoca 0.10.2; install it with: pip install rumoca==0.10.2"
        ) from None
    return rumoca


def _modification(overrides: Mapping[str, Override]) -> str:
    """`{"a.b": 1}` -> `(a(b = 1))`."""
    parts = []
    for name, value in overrides.items():
        *outer, last = name.split(".")
        inner = f"{last} = {_value_text(name, value)}"
        for part in reversed(outer):
            inner = f"{part}({inner})"
        parts.append(inner)
    return f"({', '.join(parts)})" if parts else ""


def _value_text(name: str, value: Override) -> str:
    """A value as Modelica text; a text has to be one expression, so that it cannot change more than the value."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        words = [word for word, _ in tokenise(value)]
        depths = [0, *accumulate((word in "([{") - (word in ")]}") for word in words)]
        is_balanced = min(depths) == depths[-1] == 0
        is_cut = any(word in ";\"'" or (word == "," and depth == 0) for word, depth in zip(words, depths, strict=False))
        has_comment = "".join("".join(words).split()) != "".join(value.split())
        if not words or not is_balanced or is_cut or has_comment:
            raise BuildError(f"the value set for {name}, {value}, is no single Modelica expression")
        return value
    if not isfinite(value):
        raise BuildError(f"the value set for {name} is {value}; give a finite number")
    return str(value) if isinstance(value, int) else repr(float(value))


def _explain(
    failure: BaseException, source: ClassSource, joined: JoinedText, libraries: Sequence[Path], rumoca: Any
) -> BuildError:
    text = str(failure)
    syntax = _syntax_error(text, source, libraries, rumoca)
    if syntax is not None:
        return syntax
    message = _NOISE.sub("", " ".join(text.split("\nRelated failures")[0].split()))
    message = message.replace(WRAPPER, source.name)
    if type(failure).__name__ == "PanicException":
        detail = re.search(r'detail: "([^"]*)"', text)
        message = detail.group(1) if detail else f"the Modelica compiler failed: {message}"
    message = _in_plain_words(message)
    place = PLACE.search(text)
    message = PLACE.sub("", message).strip()
    if place and WRAPPER not in place.group(1):
        file, line = Path(place.group(1)), int(place.group(2))
        if place.group(1) == _stand_in(source):
            file, line = joined.place(line)
        return BuildError(message, file, line)
    return BuildError(message, source.file, source.line)


def _in_plain_words(message: str) -> str:
    count = re.search(r"unbalanced model: (\d+) equations?, (\d+) unknowns?", message)
    if count:
        equations, unknowns = int(count.group(1)), int(count.group(2))
        cure = "add" if equations < unknowns else "remove"
        return (
            f"unbalanced model: {equations} equations for {unknowns} unknowns; "
            f"{cure} {abs(equations - unknowns)}, or make a variable an input or a parameter"
        )
    if "der(...) must name a coordinate" in message:
        return (
            "der() of an input, or of another variable that is no state, is not supported; write its equation instead"
        )
    return message


def _syntax_error(text: str, source: ClassSource, libraries: Sequence[Path], rumoca: Any) -> BuildError | None:
    """rumoca names the place of a syntax error only when asked to validate the file."""
    if "unexpected" not in text and "parse source-root" not in text:
        return None
    files = [source.file] if source.is_single_file else []
    files += [library for library in libraries if library.is_file() and library != source.file]
    files += [file for library in libraries if library.is_dir() for file in sorted(library.rglob("*.mo"))]
    for file in files:
        for found in rumoca.validate(str(file)):
            if found.rule == "syntax-error":
                place = re.search(r"\.mo:(\d+):\d+\]", found.message)
                what = re.search(r"(unexpected [^\n]*|expected [^\n]*)", found.message)
                line = int(place.group(1)) if place else found.line
                return BuildError(f"syntax error: {what.group(1) if what else found.rule}", file, line)
    return None


@contextmanager
def _quiet_stderr() -> Iterator[None]:
    """Keep what rumoca's native code writes to stderr (the backtrace of a panic) from the user."""
    sys.stderr.flush()
    try:
        keep = os.dup(2)
    except OSError:  # no stderr, as in a windowed application
        yield
        return
    with tempfile.TemporaryFile() as sink:
        os.dup2(sink.fileno(), 2)
        try:
            yield
        finally:
            os.dup2(keep, 2)
            os.close(keep)
