"""The data sets as a diagnosis is given them: one log withheld, and beside each what is right."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

from pysim.io import read_dataset
from pysim.types import BadInput, Dataset
from validation.asked import PUMP, Subject
from validation.real.machines import MACHINES

_WITHHELD = "stochastic/Tp0.5_heldout.txt"
_COLUMNS = MappingProxyType({"alphaPercent": "noise_percent", "u": "noise_u"})  # noise of a column in a truth's file
_REAL: Mapping[str, tuple[tuple[str, ...], ...]] = MappingProxyType(
    {
        "pendulum": (("pendulum.dry_friction", "pendulum.drag"),) * 2,
        "coupled-drives": (("counter.absolute",), ("drives.rising_gain",)),
        "motor-generator": (("generator.open_circuit",), ("generator.friction",)),
        "hair-dryer": (("dryer.dead_time",), ("thermocouple.lag", "dryer.heater_lag")),
        "hydraulic-actuator": (("valve.direction",),),
    }
)


@dataclass(frozen=True)
class Right:
    """The right answer.

    Args:
        order: names that are accepted for the first effect, for the second, and so on; none where nothing is missing.
        harmless: names that may stand behind them.
        unknown: whether something is missing that is in no catalogue.
    """

    order: tuple[tuple[str, ...], ...]
    harmless: tuple[str, ...] = ()
    unknown: bool = False

    def wrong(self, named: Sequence[str], complete: bool | None) -> list[str]:
        """What is wrong with the names, in the order they were given; None where completeness was not answered."""
        found = [f"{' or '.join(names)} missed" for names in self.order[len(named) :]]
        for name, names in zip(named, self.order, strict=False):
            found += [] if name in names else [f"{name} in place of {' or '.join(names)}"]
        allowed = {*self.harmless, *(name for names in self.order for name in names)}
        found += [f"{name} too many" for name in named[len(self.order) :] if name not in allowed]
        if self.unknown and complete:
            found.append("said to be complete")
        return found


@dataclass(frozen=True)
class Task:
    """What is asked.

    Args:
        name: of the data set.
        dataset: all logs; those of use "test" are for the judge alone.
        subject: the base model and its catalogue.
        right: the right answer; None where it is not known.
        noise: of each signal, in its unit, for errors as multiples of it; empty where nobody knows it.
        perfect: error of the true model on the log withheld, over the noise; None where it is not known.
    """

    name: str
    dataset: Dataset
    subject: Subject
    right: Right | None
    noise: Mapping[str, float] = field(default_factory=dict)
    perfect: float | None = None

    @property
    def given(self) -> Dataset:
        """Without the logs that are withheld."""
        return replace(self.dataset, records=tuple(r for r in self.dataset.records if r.use != "test"))


def read_task(folder: Path, name: str, *, specified: bool = True) -> Task:
    """One data set of a folder.

    Args:
        folder: holds the data sets, and beside each its truth, NAME.truth.json, where that is known.
        name: of a pump's data set, or of a real machine, "real-...".
        specified: whether the diagnosis is given the noise that the data set specifies.
    Raises:
        BadInput: a data set that is not there, or has no log to withhold.
    """
    if name.startswith("real-"):
        machine = MACHINES[name.removeprefix("real-")]
        data = machine.measurements(folder)
        return Task(name, data, machine.subject, Right(_REAL[machine.name]))
    data = read_dataset(folder / name)
    if _WITHHELD not in [record.source for record in data.records]:
        raise BadInput(f"{name}: it has no {_WITHHELD} to withhold; only the simulated pumps' sets have")
    records = tuple(replace(r, use="test") if r.source == _WITHHELD else r for r in data.records)
    signals = data.signals if specified else tuple(replace(signal, noise=None) for signal in data.signals)
    shown = replace(data, signals=signals, records=records)
    task = Task(name, shown, PUMP, None)
    path = folder / f"{name}.truth.json"
    if not path.is_file():
        return task
    truth = json.loads(path.read_text(encoding="utf-8"))
    noise = {s: replace(data.signal(s), noise=float(truth[key])).deviation for s, key in _COLUMNS.items()}
    return replace(task, right=_right(truth), noise=noise, perfect=truth.get("perfect_model", {}).get("validate"))


def _right(truth: Mapping[str, Any]) -> Right:
    """Of a file of truth: `accepted` names where it has them, else `effect`, one name or several."""
    effect = truth["effect"]
    names = (effect,) if isinstance(effect, str) else tuple(effect)
    if names in (("none",), ("unknown",)):
        return Right((), unknown=names == ("unknown",))
    return Right((tuple(truth.get("accepted", names)),) * len(names), tuple(truth.get("harmless", ())))
