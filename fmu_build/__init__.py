"""Modelica to FMU: `build` compiles a class, `BuildError` says why it could not."""

from .build import build
from .errors import BuildError

__all__ = ["BuildError", "build"]
