"""Which code answered: the text of all that a diagnosis and its judging are made of, as twelve characters."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator
from pathlib import Path

_ROOT = Path(__file__).parents[3]
_LIBRARY = "modelica/HydraulicTestBench"
_SOURCES = (
    ("pysim/diagnose", "*.py"),
    ("pysim/effects", "*.py"),
    ("pysim/identify/greybox", "*.py"),
    *((f"{_LIBRARY}/{part}", "*.mo") for part in ("Data", "Effects", "Functions", "Interfaces", "Pump")),
    ("validation/blind/plant", "*.py"),
)
# Tells the place and shape of what is missing once the verdict is found; no verdict depends on it.
_LOCATING = "pysim/diagnose/locating"
_COMPILED = (("fmu_build", "*.py"), ("fmu_build", "*.c"), ("fmu_build", "*.h"), (_LIBRARY, "*.mo"))
# What decides a stored number beside the diagnosis; the rest of this folder only runs and shows.
_JUDGE = tuple(f"validation/blind/benchmark/{name}.py" for name in ("answer", "examine", "judged", "truth"))


def fingerprint(root: Path = _ROOT, *, places: bool = False) -> str:
    """Of the sources below a root; independent of how lines end.

    Args:
        places: of answers that say where a term is missing; else of those that name the effect.
    """
    judge = [root / name for name in _JUDGE if (root / name).is_file()]
    sources = [path for path in _files(root, _SOURCES) if places or (root / _LOCATING) not in path.parents]
    return _digest(root, [*sources, *judge])


def model_fingerprint(root: Path = _ROOT) -> str:
    """Of what decides a compiled model."""
    return _digest(root, _files(root, _COMPILED))


def _digest(root: Path, paths: Iterable[Path]) -> str:
    digest = hashlib.sha256()
    for path in paths:
        text = path.read_bytes().replace(b"\r\n", b"\n")
        digest.update(f"{path.relative_to(root).as_posix()} {len(text)}\n".encode() + text)
    return digest.hexdigest()[:12]


def _files(root: Path, sources: Iterable[tuple[str, str]]) -> Iterator[Path]:
    for folder, pattern in sources:
        yield from sorted((root / folder).rglob(pattern))
