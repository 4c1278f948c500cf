"""Driving a member by hand, as the master does."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager

import numpy as np

from pysim.cosim import Member, Setup


class Driven:
    """A member between start and close; values go in and come out by name."""

    def __init__(self, member: Member, overrides: Mapping[str, float], step: float) -> None:
        self.member, self.time, self.size = member, 0.0, step
        starts = np.array([port.start or 0.0 for port in member.inputs])
        self.setup = Setup(
            0.0, 10.0, step, starts, np.zeros(starts.size), np.zeros(len(member.outputs)), dict(overrides)
        )

    def give(self, **values: float) -> None:
        for name, value in values.items():
            self.setup.inputs[[port.name for port in self.member.inputs].index(name)] = value

    def __getitem__(self, name: str) -> float:
        return float(self.setup.outputs[[port.name for port in self.member.outputs].index(name)])

    def go(self, **values: float) -> float:
        """One usual step; the time reached."""
        self.give(**values)
        end = round((self.time + self.size) / self.size) * self.size
        self.time = self.member.step(self.time, end)
        return self.time

    def rows(self, name: str, inputs: Sequence[float]) -> list[float]:
        """The output after each step with those inputs `u`."""
        found = []
        for value in inputs:
            self.go(u=value)
            found.append(self[name])
        return found


@contextmanager
def driven(member: Member, step: float = 0.1, **overrides: float) -> Iterator[Driven]:
    run = Driven(member, overrides, step)
    try:
        member.start(run.setup)
        member.begin()
        yield run
    finally:
        member.close()
