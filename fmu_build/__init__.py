"""Modelica to FMU: `build` compiles a class; `BuildError` says why not, `CannotCompile` that another compiler may."""

from fmu_build.build import build
from fmu_build.errors import BuildError, CannotCompile

__all__ = ["BuildError", "CannotCompile", "build"]
