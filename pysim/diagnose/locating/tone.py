"""A term that depends on nothing in the model: a swing of a frequency of its own, such as a shaft's, at some place."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.fitted import Fitted
from pysim.diagnose.locating.laws import UNIT, Law, Term
from pysim.diagnose.locating.shape import units
from pysim.diagnose.residuals import Ruler
from pysim.diagnose.screen import across, column_space
from pysim.diagnosis.failures import tone
from pysim.identify import HALF_95
from pysim.identify.greybox.parameters import ParameterSpace
from pysim.identify.greybox.time_log import TimeLog
from pysim.simulate import Rodas
from pysim.types import BadInput, Effect, Missing, Model
from pysim.types.diagnosis import Shape

Array = NDArray[np.float64]

_SINE, _COSINE, _FREQUENCY, _TERM = "missing_c1", "missing_c2", "missing_f", "missing_term1"
_POINTS = 81
# Between two lines of the spectrum, so many frequencies are tried.
_FINE = 40
# A swing that takes less of a log's misfit is no answer.
_LEAST = 0.05
# Steps of a run in one period of a swing, at least.
_STEPS = 10


@dataclass(frozen=True)
class Swing:
    """A sine over time where a law would be; amplitudes and frequency stay free, so that it compiles once."""

    law: Law

    @property
    def slot(self) -> str:
        """Name of the place."""
        return self.law.slot

    @property
    def probes(self) -> tuple[str, ...]:
        """As of a law; of two sides the first."""
        return tuple(probe for probe in self.law.probes if f"={_TERM}" in probe)

    @property
    def text(self) -> str:
        """Declarations and equations for a class that extends the model."""
        angle = f"({2 * math.pi!r}*{_FREQUENCY}*time)"
        lines = [f"  parameter Real {name} = 0;" for name in (_SINE, _COSINE)]
        lines += [f"  parameter Real {_FREQUENCY} = 1;", f"  parameter Real {UNIT} = 1;", f"  Real {_TERM};"]
        equations = [f"  {_TERM} = {UNIT}*({_SINE}*sin{angle} + {_COSINE}*cos{angle});"]
        if self.law.copies[0].output_rate:
            lines.append(f"  Real {_TERM}_t;")
            swing = f"({_SINE}*cos{angle} - {_COSINE}*sin{angle})"
            equations.append(f"  {_TERM}_t = {UNIT}*{2 * math.pi!r}*{_FREQUENCY}*{swing};")
        return "\n".join([*lines, "equation", *equations, ""])


def tones(
    ruler: Ruler,
    current: Fitted,
    laws: Sequence[Law],
    probed: Callable[[Sequence[Effect], Term], Model],
) -> tuple[Missing, ...]:
    """Per place the swing that explains a line standing alone in the spectrum of what is left; none without a line.

    Args:
        ruler, current: as for `locate`.
        laws: whose places are looked at.
        probed: compiles the model with a swing.
    """
    found = _strongest(ruler, current)
    if found is None:
        return ()
    number, frequency = found
    starts = np.cumsum([0, *(len(target.runs) for target in ruler.targets)])
    near = ruler.near[starts[number] : starts[number + 1]] if ruler.near else ()
    # where nothing else moves, steps would pass over the swing
    known = ruler.solver
    stepped = Rodas(rtol=known.control().rtol, atol=known.control().atol, max_step=1 / (_STEPS * frequency))
    one = ruler.with_other(targets=(ruler.targets[number],), skips=(ruler.skips[number],), near=near, solver=stepped)
    point = one.evaluation(current.what, current.point.x)
    if not point.good:
        return ()
    at = Fitted(current.what, point)
    rows: list[tuple[float, Missing]] = []
    for output in dict.fromkeys(law.copies[0].output for law in laws):
        law = next(law for law in laws if law.copies[0].output == output)
        try:
            model = probed(current.what.effects, Swing(law))
        except BadInput:
            continue
        row = _swing(one, at, Swing(law), model, frequency)
        rows += [row] if row is not None else []
    span = column_space(point.jacobian)
    rest = across(span, point.residual)
    return _shared(rows, float(rest @ rest), rest.size - span.shape[1])


def _shared(rows: Sequence[tuple[float, Missing]], whole: float, freedom: int) -> tuple[Missing, ...]:
    """The best swing of each place with its share; noise is what the best of all leaves, if that is less than told."""
    if not rows:
        return ()
    floor = min(float(freedom), min(rest for rest, _ in rows))
    best: dict[str, Missing] = {}
    for rest, row in sorted(rows, key=lambda pair: pair[0]):
        share = float(np.clip((whole - rest) / (whole - floor), 0.0, 1.0)) if whole > floor else 0.0
        if share > _LEAST:
            best.setdefault(row.slot, replace(row, share=share))
    return tuple(best.values())


def _strongest(ruler: Ruler, current: Fitted) -> tuple[int, float] | None:
    """Number of the target with the strongest line of its own, and its frequency in Hz."""
    best: tuple[float, int, float] | None = None
    for number, rows, target in _logs(ruler, current.point.residual):
        n = rows.shape[0]
        interval = float(np.median(np.diff(target.measured.time)))
        power = np.sum(np.abs(np.fft.rfft(rows - rows.mean(axis=0), axis=0)) ** 2, axis=1) / (n * rows.shape[1])
        line = tone(power)
        if line is None or (best is not None and power[line] <= best[0]):
            continue
        lines = (line + np.linspace(-1, 1, 2 * _FINE + 1)) / (n * interval)
        waves = np.exp(-2j * np.pi * np.outer(lines, np.arange(n) * interval))
        size = np.sum(np.abs(waves @ rows) ** 2, axis=1)
        best = float(power[line]), number, float(lines[np.argmax(size)])
    return None if best is None else (best[1], best[2])


def _logs(ruler: Ruler, residual: Array) -> Iterator[tuple[int, Array, TimeLog]]:
    rest = residual
    for number, (target, whitening) in enumerate(zip(ruler.targets, ruler.whitenings, strict=True)):
        own, rest = rest[: whitening.size], rest[whitening.size :]
        if isinstance(target, TimeLog):
            yield number, own.reshape(-1, len(target.measured.names)), target


def _swing(ruler: Ruler, at: Fitted, swing: Swing, model: Model, frequency: float) -> tuple[float, Missing] | None:
    """Sum of squares that the best sine at one place leaves, to first order, parameters refitted; and the sine."""
    span = column_space(at.point.jacobian)
    left_over = across(span, at.point.residual)
    for power in (0, -3, -6, -9):
        unit = 10.0**power
        space = _space(at, frequency, unit)
        point = ruler.evaluation(replace(at.what, model=model, space=space), np.zeros(2))
        if point.good and np.isfinite(point.jacobian).all():
            break
    else:
        return None
    columns = across(span, point.jacobian)
    if not np.linalg.norm(columns) > 0:
        return None
    amounts: Array = -np.asarray(np.linalg.lstsq(columns, left_over, rcond=None)[0], dtype=np.float64)
    rest = float(np.sum((left_over + columns @ amounts) ** 2))
    scale = max(1.0, rest / (left_over.size - span.shape[1]))
    covariance: Array = np.asarray(np.linalg.pinv(columns.T @ columns) * scale * unit**2, dtype=np.float64)
    return rest, _told(swing, model, frequency, amounts * unit, covariance)


def _space(at: Fitted, frequency: float, unit: float) -> ParameterSpace:
    fixed = {**at.what.space.values(at.point.x), _FREQUENCY: frequency, UNIT: unit}
    names, zero, far = (_SINE, _COSINE), np.zeros(2), np.full(2, math.inf)
    return ParameterSpace(
        names, names, (None, None), ("1", "1"), zero, -far, far, np.ones(2), np.zeros(2, dtype=bool), fixed=fixed
    )


def _told(swing: Swing, model: Model, frequency: float, amounts: Array, covariance: Array) -> Missing:
    """Two periods of it; its share is not known yet."""
    time = np.linspace(0, 2 / frequency, _POINTS)
    angle = 2 * np.pi * frequency * time
    waves = np.column_stack([np.sin(angle), np.cos(angle)])
    half = HALF_95 * np.sqrt(np.maximum(np.einsum("gi,ij,gj->g", waves, covariance, waves), 0.0))
    value, unit = waves @ amounts, units(swing.law, model)[1]
    size, phase = float(np.hypot(*amounts)), float(np.arctan2(amounts[1], amounts[0]))
    written = f"{size:.3g}" if unit == "1" else f"{size:.3g} {unit}"
    text = f"{written} sin(2 pi {frequency:.4g} Hz t {'+' if phase >= 0 else '-'} {abs(phase):.2f})"
    return Missing(swing.slot, 0.0, "time", Shape(time, value, value - half, value + half, "s", unit), text)
