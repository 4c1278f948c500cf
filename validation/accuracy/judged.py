"""What one model is judged by: the numbers of thesis Tables 1.3 and 1.4 and the steady angle, fitted and held out."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from pysim.identify import FREQUENCY_CRITERIA, TIME_CRITERIA
from pysim.types import Criterion, Deviation, Fit, Record

FIT, HELD_OUT = "fit", "validate"
ANGLE, VALVE = "alphaPercent", "u"
READING = 240 / 4096  # %, one step of the 12 bits the angle is read with
STEADY = Criterion("steady-state error", "E_ss", READING, "%", "one step of the angle's reading")
QUASI_STATIC_HZ = 0.1  # whose mean stands for the angle at rest: the logs hold no longer rest at an offset


@dataclass(frozen=True)
class Row:
    """One measured thing and how far the model is from it.

    Args:
        what: the test or log, as the data set names it, and the signal.
        use: FIT or HELD_OUT.
        deviations: those criteria that apply.
    """

    what: str
    use: str
    deviations: tuple[Deviation, ...]


@dataclass(frozen=True)
class Judged:
    """A model's rows, and what it said to the held-out wave (angle and, where it has one, valve)."""

    label: str
    rows: tuple[Row, ...]
    wave: Mapping[str, Record] = field(default_factory=dict)

    def worst(self, criterion: Criterion, use: str, signal: str) -> float | None:
        """The largest value of a criterion over the rows of that use and signal; None where the model has none."""
        values = [
            deviation.value
            for row in self.rows
            if row.use == use and row.what.endswith(f": {signal}")
            for deviation in row.deviations
            if deviation.criterion == criterion
        ]
        return max(values) if values else None

    def passes(self, use: str, signal: str) -> bool:
        """Whether every number of that use and signal is within the thesis' limits."""
        return all(d.passes for row in self.of(use, signal) for d in row.deviations if d.criterion != STEADY)

    def of(self, use: str, signal: str) -> Iterable[Row]:
        """The rows of that use and signal."""
        return (row for row in self.rows if row.use == use and row.what.endswith(f": {signal}"))


COLUMNS: tuple[tuple[Criterion, str], ...] = (
    *((criterion, ANGLE) for criterion in FREQUENCY_CRITERIA),
    *((criterion, ANGLE) for criterion in TIME_CRITERIA),
    *((criterion, VALVE) for criterion in TIME_CRITERIA),
    (STEADY, ANGLE),
)


def judged(label: str, fit: Fit, wave: str) -> Judged:
    """A grey-box fit's rows.

    Args:
        wave: source of the log that is drawn.
    """
    rows = [
        Row(f"{r.comparison.measured.test.label}: {r.comparison.measured.test.output}", r.use, r.comparison.deviations)
        for r in fit.responses
    ]
    for record in fit.records:
        for name, deviations in record.deviations.items():
            if not record.harmonics:
                rows.append(Row(f"{record.source}: {name}", record.use, deviations))
        for harmonics in record.harmonics:
            if harmonics.frequency == QUASI_STATIC_HZ:
                off = abs(harmonics.simulated[0] - harmonics.measured[0])
                rows.append(Row(f"{record.source}: {harmonics.signal}", record.use, (Deviation(STEADY, float(off)),)))
    drawn = next(record for record in fit.records if record.source == wave)
    return Judged(label, tuple(rows), {"measured": drawn.measured, label: drawn.simulated})


def table(models: Iterable[Judged]) -> list[list[str]]:
    """Head and a row per model and use: the worst of each criterion, in bold what is beyond its limit."""
    head = ["model", "data", *(f"{c.symbol} {_signal(signal)} ({c.unit})" for c, signal in COLUMNS)]
    limits = ["limit", "", *(f"{c.limit:.2g}" for c, _ in COLUMNS)]
    rows = [
        [model.label, words, *(_cell(model.worst(c, use, signal), c) for c, signal in COLUMNS)]
        for model in models
        for use, words in ((FIT, "fitted"), (HELD_OUT, "held out"))
    ]
    return [head, limits, *rows]


def _signal(name: str) -> str:
    return {ANGLE: "angle", VALVE: "valve"}[name]


def _cell(value: float | None, criterion: Criterion) -> str:
    if value is None:
        return "-"
    return f"{value:.2f}" if value <= criterion.limit else f"**{value:.2f}**"
