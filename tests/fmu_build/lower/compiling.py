"""Compiles Modelica text for tests."""

import json
import tempfile
import textwrap
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from fmu_build.front import FlatModel, load
from fmu_build.front.rumoca.worker import answer, written
from fmu_build.lower import OdeModel, lower
from fmu_build.text import ClassText


def ask_in_this_process(request: Mapping[str, Any], source: ClassText) -> dict[str, Any]:
    """What the compiler's own process would answer, without starting one for each text."""
    found: dict[str, Any] = json.loads(written(answer(dict(request))))
    return found


def loaded(text: str, name: str = "M") -> FlatModel:
    """The class `name` in `text`, a file M.mo in a folder that is gone by now."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "M.mo"
        file.write_text(textwrap.dedent(text), encoding="utf-8")
        return load(name, [file])


def compiled(text: str, name: str = "M") -> OdeModel:
    """The class `name` in `text`, lowered."""
    return lower(loaded(text, name))


def body(text: str) -> OdeModel:
    """`model M text end M;`, lowered."""
    return compiled(f"model M\n{text}\nend M;")
