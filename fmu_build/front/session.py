"""Runs rumoca: finds the class, compiles it, and turns every failure into one `BuildError` with a place."""

import os
import re
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from fmu_build.errors import BuildError
from fmu_build.front.source import ClassSource

WRAPPER = "OverridesOfThisBuild"
PLACE = re.compile(r"\[([^\[\]\n]+?\.mo):(\d+):\d+\]")


def compile_class(
    source: ClassSource, libraries: Sequence[Path], overrides: Mapping[str, float | str]
) -> tuple[dict[str, Any], dict[str, Any]]:
    """rumoca's DAE form and flat form of the class, with `overrides` as modifications."""
    roots = [str(library) for library in libraries if library.is_dir()]
    text = source.text if source.is_single_file else ""
    name = source.name
    if overrides or not source.is_single_file:
        name = WRAPPER
        text += f"\nmodel {WRAPPER}\n  extends {source.name}{_modification(overrides)};\nend {WRAPPER};\n"
    file_name = str(source.file) if source.is_single_file else f"{WRAPPER}.mo"
    rumoca = _import_rumoca()
    with _quiet_stderr():
        try:
            model = rumoca.Session(roots=roots).loads(text, model=name, filename=file_name)
            return model.to_dict("dae"), model.to_dict("flat")
        except BaseException as failure:  # a panic in rumoca is no Exception
            if isinstance(failure, KeyboardInterrupt | SystemExit):
                raise
            raise _explain(failure, source, libraries, rumoca) from None


def _import_rumoca() -> Any:
    try:
        import rumoca
    except ImportError:
        raise BuildError(
            "building from Modelica needs rumoca 0.10.2; install it with: pip install rumoca==0.10.2"
        ) from None
    return rumoca


def _modification(overrides: Mapping[str, float | str]) -> str:
    """`{"a.b": 1}` -> `(a(b = 1))`."""
    if not overrides:
        return ""
    parts = []
    for name, value in overrides.items():
        *outer, last = name.split(".")
        text = (
            str(value).lower() if isinstance(value, bool) else value if isinstance(value, str) else repr(float(value))
        )
        inner = f"{last} = {text}"
        for part in reversed(outer):
            inner = f"{part}({inner})"
        parts.append(inner)
    return f"({', '.join(parts)})"


def _explain(failure: BaseException, source: ClassSource, libraries: Sequence[Path], rumoca: Any) -> BuildError:
    text = str(failure)
    syntax = _syntax_error(text, source, libraries, rumoca)
    if syntax is not None:
        return syntax
    message = " ".join(text.split("\nRelated failures")[0].split())
    for noise in ("todae failed: ", f"{WRAPPER} could not be compiled: ", f"{WRAPPER} failed in ToDae: "):
        message = message.replace(noise, "")
    message = message.replace(WRAPPER, source.name)
    if type(failure).__name__ == "PanicException":
        detail = re.search(r'detail: "([^"]*)"', text)
        message = detail.group(1) if detail else f"the Modelica compiler failed: {message}"
    place = PLACE.search(text)
    if place and WRAPPER not in place.group(1):
        return BuildError(message.replace(place.group(0), "").strip(), Path(place.group(1)), int(place.group(2)))
    if place:
        return BuildError(f"a value set for {source.name} does not fit: {message.replace(place.group(0), '').strip()}")
    return BuildError(message, source.file, source.line)


def _syntax_error(text: str, source: ClassSource, libraries: Sequence[Path], rumoca: Any) -> BuildError | None:
    """rumoca names the place of a syntax error only when asked to validate the file."""
    if "unexpected" not in text and "parse source-root" not in text:
        return None
    files = [source.file] if source.is_single_file else []
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
