"""Compiles Modelica text for tests."""

import tempfile
import textwrap
from pathlib import Path

from fmu_build.front import load
from fmu_build.lower import OdeModel, lower


def compiled(text: str, name: str = "M") -> OdeModel:
    """The class `name` in `text`, lowered."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / f"{name}.mo"
        file.write_text(textwrap.dedent(text), encoding="utf-8")
        return lower(load(name, [file]))


def body(text: str) -> OdeModel:
    """`model M text end M;`, lowered."""
    return compiled(f"model M\n{text}\nend M;")
