"""Runs rumoca: finds the class, compiles it, and turns every failure into one `BuildError` with a place."""

import importlib.util
import json
import os
import re
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from fmu_build.cache import cache_folder
from fmu_build.errors import BuildError
from fmu_build.front.overrides import Override, modification
from fmu_build.front.rumoca.failures import unresolved
from fmu_build.front.rumoca.joined import WRAPPER, JoinedText, join
from fmu_build.front.rumoca.refusals import FAILED
from fmu_build.front.rumoca.words import in_plain_words
from fmu_build.text.classes import ClassText
from fmu_build.text.libraries import read_text
from fmu_build.text.lookup import Libraries

_NOISE = re.compile(r"^(?:[a-z]+ failed: )?(?:\S+ (?:could not be compiled|failed in \w+): )?")
_BYTES = re.compile(r"start: BytePos\((\d+)\), end: BytePos\((\d+)\)")
_NO_MEMORY = b"memory allocation of"  # what a program in Rust says when it has none left
_WORKER = Path(__file__).with_name("worker.py")
# A compiler that hangs is ended; a library on a slow machine is not: ours, of 0.45 MB, takes 3 s.
_LONGEST_S, _LONGEST_S_PER_MB = 60.0, 60.0
PLACE = re.compile(r"\[([^\[\]\n]+?\.mo):(\d+):\d+\]")


def compile_class(
    source: ClassText, libraries: Sequence[Path], overrides: Mapping[str, Override]
) -> tuple[dict[str, Any], dict[str, Any]]:
    """rumoca's DAE form and flat form of the class, with `overrides` as modifications.

    Raises:
        BuildError: the class cannot be compiled, or only without the overrides, which are then the cause.
    """
    modified = modification(overrides)
    try:
        return _compile(source, libraries, modified)
    except BuildError as failure:
        if not overrides:
            raise
        _compile(source, libraries, "")  # where this fails too, the model is at fault
        raise BuildError(
            f"{source.full_name} does not compile with the values set, {modified}: {failure.message}"
        ) from None


def _compile(source: ClassText, libraries: Sequence[Path], modified: str) -> tuple[dict[str, Any], dict[str, Any]]:
    roots = [str(library) for library in libraries if library.is_dir()]
    joined = join(source, libraries)
    text = joined.text
    name, is_single = source.full_name, source.source.file in libraries
    if modified or not is_single:
        name = WRAPPER
        named = "" if is_single else _imports(libraries)
        text += f"\nmodel {WRAPPER}\n{named}  extends {source.full_name}{modified};\nend {WRAPPER};\n"
    file_name = _stand_in(source) if joined.parts else f"{WRAPPER}.mo"
    files = [str(file) for file in (*joined.parts, *_library_files(libraries))]
    request = {"roots": roots, "text": text, "name": name, "file_name": file_name, "files": files}
    answer = _ask_rumoca(request, source)
    if "forms" not in answer:
        raise _explain(answer, source, joined, libraries)
    dae, flat = answer["forms"]
    for known in dae["source_map"]["files"]:  # [number, name, text]
        if known[1] == _stand_in(source):
            known[1] = joined
    return dae, flat


def _imports(libraries: Sequence[Path]) -> str:
    """Names each library: rumoca reads those that the text names, and not those that the classes of another name."""
    names = dict.fromkeys(library.name for library in libraries if library.is_dir())  # one may be given twice
    return "".join(f"  import {name};\n" for name in names)


def _stand_in(source: ClassText) -> str:
    """A name in a folder that does not exist: rumoca also reads all other .mo files of a real one."""
    return f"FolderOfThisBuild/{source.source.file.name}"


def _library_files(libraries: Sequence[Path]) -> list[Path]:
    return [file for library in libraries if library.is_dir() for file in sorted(library.rglob("*.mo"))]


def _ask_rumoca(request: Mapping[str, Any], source: ClassText) -> dict[str, Any]:
    """What the worker answers. It costs 0.1 s to start; without it, an abort in the parser would end this process."""
    if importlib.util.find_spec("rumoca") is None:
        raise BuildError("building from Modelica needs rumoca 0.10.2; install it with: pip install rumoca==0.10.2")
    size = sum(map(os.path.getsize, request["files"]), len(request["text"]))
    longest = _LONGEST_S + _LONGEST_S_PER_MB * size / 1e6
    try:
        done = subprocess.run(
            [sys.executable, "-P", str(_WORKER)],
            input=json.dumps(request).encode(),
            capture_output=True,
            env=_surroundings(),
            timeout=longest,
            check=False,
        )
    except subprocess.TimeoutExpired:
        raise BuildError(
            f"the Modelica compiler was not done with {source.full_name} within {longest:.0f} s and was ended; "
            "leave out parts of the class to find what it cannot take",
            *source.place(source.start),
        ) from None
    try:
        answer: dict[str, Any] = json.loads(done.stdout)
        return answer
    except ValueError:
        last = done.stderr.decode(errors="replace").strip().splitlines()[-1:]
        if _NO_MEMORY in done.stderr:
            raise BuildError(
                f"the Modelica compiler needs more memory for {source.full_name} than it is given; choose smaller "
                "arrays and shorter loops",
                *source.place(source.start),
            ) from None
        said = "; ".join([f"exit code {done.returncode}", *last])
        raise BuildError(
            f"the Modelica compiler crashed on {source.full_name} ({said}); "
            "leave out parts of the class to find what it cannot take",
            *source.place(source.start),
        ) from None


def _surroundings() -> dict[str, str]:
    """Without the variable from which rumoca would take libraries that were not named, and that no cache knows of.

    What it keeps of the files it has read becomes part of a model, so it lies where no other user can write.
    """
    kept = {name: value for name, value in os.environ.items() if name.upper() != "MODELICAPATH"}
    ours = str(cache_folder("modelica"))
    return {**kept, "PYTHONPATH": os.pathsep.join(filter(None, sys.path)), "XDG_CACHE_HOME": ours}


def _explain(answer: Mapping[str, Any], source: ClassText, joined: JoinedText, libraries: Sequence[Path]) -> BuildError:
    text = str(answer["failure"])
    if answer["syntax"] is not None:
        return _syntax_error(*answer["syntax"])
    message = _NOISE.sub("", " ".join(text.split("\nRelated failures")[0].split()))
    message = message.replace(WRAPPER, source.full_name)
    if answer["panic"]:
        detail = re.search(r'detail: "([^"]*)"', text)
        message = detail.group(1) if detail else f"the Modelica compiler failed: {message}"
    message = in_plain_words(message)
    place = PLACE.search(text)
    message = PLACE.sub("", message).strip()
    if place and WRAPPER not in place.group(1):
        file, line = Path(place.group(1)), int(place.group(2))
        if place.group(1) == _stand_in(source):
            file, line = joined.place(line)
        return BuildError(message, file, line)
    nameless = BuildError(message, *(_place_of_bytes(text, joined, libraries) or source.place(source.start)))
    classes = Libraries(libraries)
    miscounted = (refusal.check(message, source, classes) for refusal in FAILED)
    return unresolved(message, source, classes) or next(filter(None, miscounted), nameless)


def _place_of_bytes(text: str, joined: JoinedText, libraries: Sequence[Path]) -> tuple[Path, int] | None:
    """File and line of the der(...) that a panic names by its bytes, without the file they are counted in."""
    found = _BYTES.search(text)
    if not found or "derivative" not in text:
        return None
    begin, end = int(found.group(1)), int(found.group(2))
    for file, content in ((None, joined.text), *((file, read_text(file)) for file in _library_files(libraries))):
        written = content.encode()
        if re.fullmatch(rb"der\s*\(.*\)", written[begin:end], re.DOTALL):
            line = written.count(b"\n", 0, begin) + 1
            return joined.place(line) if file is None else (file, line)
    return None


def _syntax_error(file: str, line: int, message: str) -> BuildError:
    place = re.search(r"\.mo:(\d+):\d+\]", message)
    what = re.search(r"(unexpected [^\n]*|expected [^\n]*)", message)
    line = int(place.group(1)) if place else line
    words = what.group(1) if what else " ".join(message.split())
    return BuildError(f"syntax error: {words}", Path(file), line)
