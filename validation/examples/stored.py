"""Stored results: a CSV file per example, made by the other solver."""

from __future__ import annotations

import importlib.metadata
import io
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from pysim.io import read_model
from validation.examples.catalogue import Example
from validation.examples.runs import CVODE_TOLERANCE, built, by_cvode, columns

Array = NDArray[np.float64]

_DIGITS = 9  # a hundred times finer than the tightest tolerance


def store(example: Example) -> None:
    """Run the example by CVODE and write its stored result.

    Raises:
        BuildError: it does not compile. LookupError: it needs a library that is not there.
    """
    fmu = built(example)
    names = columns(read_model(fmu))
    values = by_cvode(fmu, example.times, names)
    table = np.column_stack([example.times, *(values[name] for name in names)])
    text = io.StringIO()
    tool = f"FMPy {importlib.metadata.version('fmpy')}, CVODE, tolerance {CVODE_TOLERANCE:g}"
    text.write(f"# {example.name}, by {tool}; python -m validation.examples store {example.short}\n")
    text.write(",".join(_quoted(name) for name in ("time", *names)) + "\n")
    np.savetxt(text, table, fmt=f"%.{_DIGITS}g", delimiter=",")
    example.file.parent.mkdir(exist_ok=True)
    example.file.write_text(text.getvalue(), encoding="utf-8", newline="\n")


def read(example: Example) -> Mapping[str, Array]:
    """Columns (n_t,) by name, `time` first.

    Raises:
        FileNotFoundError: it has no stored result.
    """
    _, head, *rows = example.file.read_text(encoding="utf-8").splitlines()
    names = _split(head)
    table = np.array([[float(word) for word in row.split(",")] for row in rows])
    return {name: table[:, column] for column, name in enumerate(names)}


def _quoted(name: str) -> str:
    return f'"{name}"' if "," in name else name


def _split(head: str) -> list[str]:
    """Names of variables hold commas only inside brackets of arrays, which are quoted."""
    parts = head.split('"')
    words = []
    for k, part in enumerate(parts):
        words += [part] if k % 2 else [word for word in part.split(",") if word]
    return words
