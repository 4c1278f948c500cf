"""What a bench is to do: signals, how they are measured and logged, and the tests."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from pysim.bench.bench_tests import BenchTest, Run
from pysim.bench.logger import Logger
from pysim.bench.sensor import Sensor
from pysim.io import same_file, unusable_name
from pysim.types import BadInput


@dataclass(frozen=True)
class Plan:
    """A test plan; numbers in SI units or %.

    Args:
        name, description, system: of the data set.
        sensors: one per signal, inputs too.
        tests: in the order in which they are run.
        logger: of all logs.
        inputs: values of the model's inputs that no test drives, in their units.
        follows: input -> (another input, how many of its units per unit of that one): it goes along whenever the other
            is driven, and is logged with it.
        units: signal -> (unit in the files, how many SI units that is); the SI unit where not specified.
    Raises:
        BadInput: no test, a signal named twice, a test of an unknown signal or of one in the wrong role, an input that
            follows itself or what is none, two tests that would write the same file, on whatever system, or one whose
            file Windows has no name for.
    """

    name: str
    description: str
    system: str
    sensors: tuple[Sensor, ...]
    tests: tuple[BenchTest, ...]
    logger: Logger
    inputs: Mapping[str, float] = field(default_factory=dict)
    follows: Mapping[str, tuple[str, float]] = field(default_factory=dict)
    units: Mapping[str, tuple[str, float]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        names = [sensor.signal.name for sensor in self.sensors]
        for name in names:
            if names.count(name) > 1:
                raise BadInput(f"plan {self.name!r}: the signal {name!r} stands there twice; name each once")
        if not self.tests:
            raise BadInput(f"plan {self.name!r} has no tests; add one")
        driven = [sensor.signal.name for sensor in self.sensors if sensor.signal.role == "input"]
        for name, (other, _) in self.follows.items():
            if name not in driven or other not in driven or other in self.follows or name == other:
                free = ", ".join(d for d in driven if d not in self.follows)
                raise BadInput(f"plan {self.name!r}: {name!r} follows {other!r}; an input can follow one of {free}")
        for test in self.tests:
            self._check(test)
        self._check_files()

    def _check_files(self) -> None:
        seen: dict[str, str] = {}
        for source in (run.source for run in self.runs()):
            why = unusable_name(source)
            if why:
                raise BadInput(f"plan {self.name!r}: a test is logged to {source!r}, but {why}; name it anew")
            one = same_file(source)
            if one in seen:
                both = source if seen[one] == source else f"{seen[one]} and {source}, one file on Windows and macOS"
                raise BadInput(f"plan {self.name!r}: two tests are logged to {both}; name one of them anew or drop it")
            seen[one] = source

    def _check(self, test: BenchTest) -> None:
        if not test.outputs:
            raise BadInput(f"plan {self.name!r}: a test measures nothing; name one output or more")
        for role, names in (("input", (test.input,)), ("output", test.outputs)):
            known = [sensor.signal.name for sensor in self.sensors if sensor.signal.role == role]
            for name in names:
                if name not in known:
                    raise BadInput(
                        f"plan {self.name!r}: {name!r} is no signal with the role {role}; use {', '.join(known)}"
                    )

    def sensor(self, name: str) -> Sensor:
        """The sensor of that signal."""
        return next(sensor for sensor in self.sensors if sensor.signal.name == name)

    def along(self, driven: str) -> dict[str, float]:
        """Inputs that go along with a driven one, and by how much, in SI units per SI unit."""
        return {name: ratio for name, (other, ratio) in self.follows.items() if other == driven}

    def runs(self) -> tuple[Run, ...]:
        """Every run of every test, in order."""
        return tuple(run for test in self.tests for run in test.runs(self.units.get(test.input, ("", 1.0))[1]))
