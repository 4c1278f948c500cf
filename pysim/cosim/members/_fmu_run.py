"""One run of an FMU, of whatever kind, and what stands in its place while there is none."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

from pysim.cosim.member import Setup
from pysim.types import BadInput


class FmuRun(Protocol):
    """One run of an FMU: the calls of `Member`."""

    event: bool

    def start(self, setup: Setup, overrides: Mapping[str, float]) -> None: ...
    def begin(self) -> None: ...
    def update(self) -> None: ...
    def step(self, time: float, end: float) -> float: ...
    def save(self, into: Any = None) -> Any: ...
    def restore(self, state: Any) -> None: ...
    def close(self) -> None: ...


class Closed:
    """Between two runs."""

    event = False

    def __init__(self, name: str) -> None:
        self._name = name

    def start(self, setup: Setup, overrides: Mapping[str, float]) -> None:
        self._refuse()

    def begin(self) -> None:
        self._refuse()

    def update(self) -> None:
        self._refuse()

    def step(self, time: float, end: float) -> float:
        return self._refuse()

    def save(self, into: Any = None) -> Any:
        self._refuse()

    def restore(self, state: Any) -> None:
        self._refuse()

    def close(self) -> None:
        pass

    def _refuse(self) -> float:
        raise BadInput(f"{self._name} has not been started; call start first")
