"""The exceptions of the build: something in the model or the call, said with its place."""

from pathlib import Path

from fmu_build.text.tokens import printable


class BuildError(Exception):
    """Modelica text that cannot become an FMU; `str()` is "file:line: message" as far as the place is known."""

    def __init__(self, message: str, file: Path | None = None, line: int | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.file = file
        self.line = line

    def __str__(self) -> str:
        place = ":".join(str(part) for part in (self.file, self.line) if part is not None)
        return printable(f"{place}: {self.message}" if place else self.message)


class CannotCompile(BuildError):
    """Our own compiler cannot take a class that is there; another compiler may."""


class WrongCall(BuildError):
    """A name or a value in the call that no compiler could use."""


class Underdetermined(BuildError):
    """Equations that leave something open, contradict each other, or say the same twice."""
