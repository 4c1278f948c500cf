"""A model on a command line: an FMU, or a Modelica class that is built first."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pysim.types import Model

WHAT = "an .fmu, or a Modelica class"


def add_library(parser: argparse.ArgumentParser, of: str = "the model") -> None:
    """`--library`."""
    parser.add_argument(
        "--library",
        metavar="PATH",
        type=Path,
        action="append",
        default=[],
        help=f"Modelica library with {of}: folder with package.mo, or .mo file; repeat",
    )


def is_fmu(text: str) -> bool:
    """Whether it names a file and no class."""
    return text.lower().endswith(".fmu") or Path(text).is_file()


def read_fmu_or_class(text: str, libraries: Sequence[Path]) -> Model:
    """The model of an FMU, or of a Modelica class once it is built.

    Args:
        libraries: of the user; the one that comes along is always there.
    Raises:
        BadInput: an FMU that cannot be read. BuildError: a class that does not compile.
    """
    from pysim.io import read_model

    if is_fmu(text):
        return read_model(Path(text))
    from pysim.cli.progress import Working

    with Working(f"Building {text}"):
        import fmu_build

        return read_model(fmu_build.build(text, libraries=list(libraries)))
