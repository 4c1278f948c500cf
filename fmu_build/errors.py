"""The exceptions of the build: something in the model or the call, said with its place."""

from pathlib import Path


class BuildError(Exception):
    """Modelica text that cannot become an FMU; `str()` is "file:line: message" as far as the place is known."""

    def __init__(self, message: str, file: Path | None = None, line: int | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.file = file
        self.line = line

    def __str__(self) -> str:
        if self.file is None:
            return self.message
        place = str(self.file) if self.line is None else f"{self.file}:{self.line}"
        return f"{place}: {self.message}"


class CannotCompile(BuildError):
    """Our own compiler cannot take a class that is there; another compiler may."""


class WrongCall(BuildError):
    """A name or a value in the call that no compiler could use."""


class Underdetermined(BuildError):
    """Equations that leave something open, contradict each other, or say the same twice."""
