"""Modelica to FMU: `build` compiles a class, `BuildError` says why it could not."""

from fmu_build.build import build
from fmu_build.errors import BuildError

__all__ = ["BuildError", "build"]
