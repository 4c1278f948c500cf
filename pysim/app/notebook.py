"""The same steps in Python, as a notebook to run in the project's folder."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

from pysim.app.project import Project


def notebook(project: Project) -> str:
    """A notebook in Jupyter's form, version 4."""
    cells: list[dict[str, Any]] = []
    for number, (words, code) in enumerate(_cells(project)):
        cells.append({"cell_type": "markdown", "id": f"words-{number}", "metadata": {}, "source": words})
        kept: dict[str, Any] = {"metadata": {}, "execution_count": None, "outputs": []}
        cells.append({"cell_type": "code", "id": f"code-{number}", "source": code, **kept})
    about = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}}
    return json.dumps({"nbformat": 4, "nbformat_minor": 5, "metadata": about, "cells": cells}, indent=1) + "\n"


def _cells(project: Project) -> Iterator[tuple[str, str]]:
    """What each step is, and its lines."""
    settings, values = project.settings(), project.values()
    libraries = [*project.libraries]
    yield "The measurements, prepared as dataset.toml says.", 'import pysim\n\ndata = pysim.load("data")\ndata.check()'
    lines = [f"model = pysim.model({settings.model!r}" + (f", library={libraries!r})" if libraries else ")")]
    if values:
        lines.append(f"model = model.set(**{values!r})")
    named = [name for name in settings.free if name not in settings.ranges]
    if settings.free or settings.ranges:
        names = [*map(repr, named)] if settings.free else ["*model.free_names"]
        lines.append(f"model = model.free({', '.join([*names, f'**{settings.ranges!r}'])})")
    yield "The model, its values, and what a fit may change.", "\n".join([*lines, "model"])
    yield "How far the model is from the measurements.", "pysim.compare(model, data)"
    yield "The fit; `fit.warnings` says why not to believe it.", "fit = pysim.fit(model, data)\nfit"
    if settings.added:
        effects = ", ".join(map(repr, settings.added))
        yield "The model with what was added.", f"fit = pysim.fit(model.with_effects({effects}), data)\nfit"
        yield "Before and after.", "pysim.compare(model, fit.model, data)"
    else:
        yield "What is missing.", "why = pysim.diagnose(model, data)\nwhy"
    yield "Class, FMU and fitted values, to take away.", 'fit.model.export("taken")'
