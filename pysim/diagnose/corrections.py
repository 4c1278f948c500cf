"""Finds the nuisances that the data hold, takes them off the measurements, and leaves out wrong starts."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from pysim.diagnose.fitted import Fitted
from pysim.diagnose.nuisance import GAIN, OFFSET, SHIFT, Suspect, suspects
from pysim.diagnose.refit import chord_refit
from pysim.diagnose.residuals import Ruler
from pysim.diagnose.screen import column_space
from pysim.diagnose.subject import Extended
from pysim.diagnose.whiten import whitening
from pysim.identify.greybox.evaluation import Evaluation
from pysim.identify.greybox.log_target import LogTarget
from pysim.identify.greybox.sine_log import SineLog
from pysim.identify.greybox.sine_target import SineTarget
from pysim.identify.greybox.target import Target
from pysim.simulate import simulate_many
from pysim.types import Outcome

Array = NDArray[np.float64]

# Standard deviations from which a nuisance counts as found: noise alone does that once in 16,000 times.
CERTAIN = 4.0
# s after which a plate that moved when its log began is at rest; s at its start in which that shows.
_OVER, _SHOWS = 0.8, 0.15
# A wrong start shows with this chance by noise alone, and the model moves little while it does.
_BY_CHANCE, _STILL = 1e-6, 0.25
# Fall of the sum of squares from which another refit is worth its runs.
_WORTH = 1.0


@dataclass(frozen=True)
class Nuisance:
    """What the measurements say of one suspect.

    Args:
        suspect: which.
        value: share beyond 1, the signal's unit, or s.
        low, high: of the 95 percent interval.
        found: whether it is there beyond doubt.
    """

    suspect: Suspect
    value: float
    low: float
    high: float
    found: bool


def nuisances(ruler: Ruler, what: Extended, point: Evaluation) -> tuple[Nuisance, ...]:
    """Estimates of every suspect at a fitted point, beside what was taken off already.

    The intervals allow for what the parameters of the model can take over.

    Args:
        point: of the ruler.
    """
    whole = ruler.whole(what, point) if ruler.suspected else None
    if whole is None:
        return ()
    residual, slopes = whole[:, 0], whole[:, 1:]
    q, r = _triangle(np.column_stack([_scaled(slopes), ruler.span.columns]), slopes.shape[1])
    values = np.linalg.lstsq(r, q.T @ residual, rcond=None)[0]
    spread = np.sqrt(np.diag(np.linalg.pinv(r.T @ r)))
    inflated = math.sqrt(max(1.0, point.cost / max(ruler.freedom - point.x.size, 1)))
    found = []
    for suspect, rest, std in zip(ruler.suspected, values, inflated * spread, strict=True):
        value = _joined(ruler.taken, suspect, float(rest))
        found.append(Nuisance(suspect, value, value - 1.96 * std, value + 1.96 * std, abs(value) > CERTAIN * std))
    return tuple(found)


def _triangle(columns: Array, skip: int) -> tuple[Array, Array]:
    """The last columns once the first are taken off: orthonormal ones and the triangle behind them."""
    q, s, _ = np.linalg.svd(columns[:, :skip], full_matrices=False)
    reach = q[:, s > 1e-6 * s[0]] if skip and s.size else q[:, :0]
    rest = columns[:, skip:]
    for _ in range(2):
        rest = rest - reach @ (reach.T @ rest)
    return np.linalg.qr(rest)


def _scaled(slopes: Array) -> Array:
    sizes = np.linalg.norm(slopes, axis=0)
    return np.asarray(slopes / np.where(sizes > 0, sizes, 1.0))


def _joined(taken: Mapping[Suspect, float], suspect: Suspect, rest: float) -> float:
    """A nuisance in the measurements as they came, from what is left of it in corrected ones."""
    before = taken.get(suspect, 0.0)
    if suspect.kind == GAIN:
        return (1 + before) * (1 + rest) - 1
    if suspect.kind == OFFSET:
        return before + (1 + taken.get(replace(suspect, kind=GAIN), 0.0)) * rest
    return before + rest


@dataclass(frozen=True)
class Settled:
    """A fitted model and its rulers once the nuisances beside it are known.

    Args:
        seen: estimates of every suspect.
        near: (n,) of the model, around which they are allowed for; None where the ruler is as before.
    """

    ruler: Ruler
    held: Ruler | None
    at: Fitted
    seen: tuple[Nuisance, ...]
    near: Array | None = None

    @property
    def targets(self) -> tuple[Target, ...]:
        """Measurements without the nuisances that were found."""
        return (*self.ruler.targets, *(self.held.targets if self.held else ()))


def settled(ruler: Ruler, held: Ruler | None, at: Fitted, *, rounds: int = 2) -> Settled:
    """Takes the nuisances that are found beside a fitted model off the measurements and refits, until none changes.

    Those that were taken off before and are not found beside this model are put back. What is left of each stays
    allowed for to first order, found or not, so that a count changes little by this; what is reported, held out or
    drawn is then free of them.
    """
    seen, near = nuisances(ruler, at.what, at.point), None
    for _ in range(rounds):
        if not _moved(ruler, seen):
            break
        near = at.point.x
        ruler, held = taken_off(ruler, held, {n.suspect: n.value for n in seen if n.found}, at.what, near)
        at = _lean_refit(ruler, Fitted(at.what, ruler.evaluation(at.what, near)))
        seen = nuisances(ruler, at.what, at.point)
    if near is None:
        lean = _lean_refit(ruler, at)
        if lean is not at:
            at, seen = lean, nuisances(ruler, at.what, lean.point)
    return Settled(ruler, held, at, seen, near)


def taken_off(
    ruler: Ruler, held: Ruler | None, amounts: Mapping[Suspect, float], what: Extended, near: Array
) -> tuple[Ruler, Ruler | None]:
    """Rulers of measurements without nuisances of these sizes, and with none but these taken off.

    Args:
        near: (n,) of the model, around which the rest is allowed for.
    """
    ruler, held = _with(ruler, amounts), None if held is None else _with(held, amounts)
    answers = _answers(ruler, what, near)
    return (ruler if answers is None else ruler.with_other(near=tuple(answers))), held


def _lean_refit(ruler: Ruler, at: Fitted) -> Fitted:
    """The best point where only those nuisances are allowed for that were found; the same where it is that already.

    A parameter that one of the others could stand in for is then told by the data, and what is held out, where
    nuisances are not allowed for, is counted with it.
    """
    rows = ruler.whole(at.what, at.point)
    if rows is None:
        return at
    lean = ruler.with_other(suspected=tuple(s for s in ruler.suspected if s in ruler.taken))
    first = lean.counted(at.point.x, rows)
    reach = column_space(first.jacobian)
    if float(np.sum((reach.T @ first.residual) ** 2)) < _WORTH:
        return at
    end = ruler.evaluation(at.what, chord_refit(lean, at.what, first).x)
    return Fitted(at.what, end) if end.good else at


def _moved(ruler: Ruler, seen: Sequence[Nuisance]) -> bool:
    """Whether some nuisance is not where it was taken off, by more than half its standard deviation."""
    return any(
        abs((n.value if n.found else 0.0) - ruler.taken.get(n.suspect, 0.0)) > 0.5 * (n.high - n.low) / 3.92
        for n in seen
    )


def _with(ruler: Ruler, amounts: Mapping[Suspect, float]) -> Ruler:
    targets = tuple(_target(t, ruler.taken, amounts) for t in ruler.targets)
    return ruler.with_other(targets=targets, taken=dict(amounts))


def _target(target: Target, before: Mapping[Suspect, float], amounts: Mapping[Suspect, float]) -> Target:
    if isinstance(target, LogTarget):
        late = _late(amounts, target.dataset) - _late(before, target.dataset)
        values, noise = _undone(target, target.dataset, before, amounts)
        run = target.run.experiment
        times = np.maximum(run.times + late, run.start + 1e-9 * np.arange(run.times.size))
        measured = replace(target.measured, values=values, time=target.measured.time + late)
        return replace(
            target, measured=measured, noise=noise, run=replace(target.run, experiment=replace(run, times=times))
        )
    if isinstance(target, SineTarget):
        late = _late(amounts, target.dataset) - _late(before, target.dataset)
        logs = []
        for log in target.logs:
            values, noise = _undone(log, target.dataset, before, amounts)
            measured = replace(log.measured, values=values, time=log.measured.time + late)
            logs.append(replace(log, measured=measured, noise=noise))
        return replace(target, logs=tuple(logs))
    return target


def _late(amounts: Mapping[Suspect, float], dataset: str) -> float:
    return amounts.get(Suspect(SHIFT, dataset, ""), 0.0)


def _undone(
    log: LogTarget | SineLog, dataset: str, before: Mapping[Suspect, float], amounts: Mapping[Suspect, float]
) -> tuple[Array, tuple[float, ...]]:
    """Values and noise with other gains and offsets taken off than before."""
    values, noise = np.array(log.measured.values), []
    for j, (name, size) in enumerate(zip(log.measured.names, log.noise, strict=True)):
        old, new = (
            (1 + a.get(Suspect(GAIN, dataset, name), 0.0), a.get(Suspect(OFFSET, dataset, name), 0.0))
            for a in (before, amounts)
        )
        values[:, j] = (old[0] * values[:, j] + old[1] - new[1]) / new[0]
        noise.append(size * old[0] / new[0])
    return values, tuple(noise)


def allowing(ruler: Ruler, held: Ruler | None, what: Extended, x: Array) -> tuple[Ruler, Ruler | None]:
    """Rulers that allow for every nuisance: gains, offsets and shifts in what is fitted, wrong starts in all.

    What is held out takes no part in telling nuisances: it is counted as it is once they are corrected.

    Args:
        x: (n,) of the model, near the plant; the rulers stay as they are where it cannot be simulated there.
    """
    found = []
    for one in (ruler, held):
        values = None if one is None else _answers(one, what, x)
        if one is None or values is None:
            found.append(one)
            continue
        skips = tuple(
            _OVER if skip or (isinstance(t, LogTarget) and _wrong_start(one, t, values[place])) else 0.0
            for t, skip, place in zip(one.targets, one.skips, _places(one), strict=True)
        )
        if one is ruler:
            one = one.with_other(suspected=suspects(one.targets), near=tuple(values))
        found.append(one.with_other(skips=skips))
    assert found[0] is not None
    return found[0], found[1]


def _answers(ruler: Ruler, what: Extended, x: Array) -> list[Array] | None:
    """Of every run."""
    runs = ruler.experiments(what.space.values(x))
    records = simulate_many(what.model, runs, solver=ruler.solver, workers=ruler.workers)
    good = all(r.outcome is Outcome.DONE and np.isfinite(r.values).all() for r in records)
    return [r.values for r in records] if good else None


def _places(ruler: Ruler) -> list[int]:
    """Of each target's first run."""
    return np.cumsum([0, *(len(t.runs) for t in ruler.targets)])[:-1].tolist()


def _wrong_start(ruler: Ruler, target: LogTarget, simulated: Array) -> bool:
    """Whether the log leaves a model that starts at rest at once, before the model's motion could explain it."""
    since = target.measured.time - target.measured.time[0]
    early = since < _SHOWS
    if since[-1] < 4 * _OVER or early.sum() < 3:
        return False
    noise = np.array(target.noise)
    apart = ((target.measured.values - simulated) / noise)[early]
    moved = (simulated / noise)[early]
    apart, moved = apart - apart.mean(axis=0), moved - moved.mean(axis=0)
    if np.sum(apart**2) < _STILL**2 * np.sum(moved**2):
        return False
    whole = np.zeros(simulated.shape)
    whole[early] = apart
    independent = whitening(target, ruler.noise).of(whole.reshape(-1, 1)).reshape(simulated.shape)[early]
    return float(np.sum(independent**2)) > float(stats.chi2.isf(_BY_CHANCE, apart.size))


def in_words(seen: Sequence[Nuisance], units: Mapping[str, str]) -> list[str]:
    """A sentence for each nuisance that was found.

    Args:
        units: of the signals.
    """
    return [_sentence(n, units) for n in seen if n.found]


def _sentence(n: Nuisance, units: Mapping[str, str]) -> str:
    name, reach = n.suspect.signal, 0.5 * (n.high - n.low)
    if n.suspect.kind == GAIN:
        return f"{name} reads {100 * n.value:+.3g} +- {100 * reach:.2g} percent: a gain of its sensor"
    if n.suspect.kind == OFFSET:
        unit = units.get(name, "")
        return f"{name} is off by {n.value:+.3g} +- {reach:.2g} {unit}: an offset of its sensor".replace("  ", " ")
    return f"outputs are logged {1e3 * n.value:+.3g} +- {1e3 * reach:.2g} ms after the command: a shift of clocks"
