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
from pysim.diagnose.screen import across, column_space
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
# Usual sizes up to which one is taken for a nuisance: what asks for more has another cause.
PLAUSIBLE = 3.0
# s after which a plate that moved when its log began is at rest; s at its start in which that shows.
_OVER, _SHOWS = 0.8, 0.15
# A wrong start shows with this chance by noise alone, and the model moves little while it does.
_BY_CHANCE, _STILL = 1e-6, 0.25
# Share of a nuisance that parameters have to leave for it to be told from them.
_ALIKE = 1e-2
# Mean squares up to which nuisances are taken off on trial, and up to which that is then kept.
_FAR, _EXPLAINED = 20.0, 1.3
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
    reach = column_space(slopes)
    sizes = np.maximum(np.linalg.norm(ruler.span.columns, axis=0), np.finfo(float).tiny)
    rest = across(reach, across(reach, ruler.span.columns / sizes))
    told = np.linalg.norm(rest, axis=0) > _ALIKE
    values, spread = np.zeros(sizes.size), np.full(sizes.size, math.inf)
    q, r = np.linalg.qr(rest[:, told])
    usual = np.array([s.width for s in ruler.suspected])[told] * sizes[told]
    before = np.array([ruler.taken.get(s, 0.0) for s in ruler.suspected])[told] * sizes[told]
    doubt = np.linalg.pinv(r.T @ r + np.diag(usual**-2), hermitian=True)
    values[told] = doubt @ (r.T @ (q.T @ residual) - before / usual**2) / sizes[told]
    spread[told] = np.sqrt(np.diag(doubt)) / sizes[told]
    inflated = math.sqrt(max(1.0, point.cost / max(ruler.freedom - point.x.size, 1)))
    found = []
    for suspect, left, std in zip(ruler.suspected, values.tolist(), (inflated * spread).tolist(), strict=True):
        value = _joined(ruler.taken, suspect, left)
        there = CERTAIN * std < abs(value) < PLAUSIBLE * suspect.width
        found.append(Nuisance(suspect, value, value - 1.96 * std, value + 1.96 * std, there))
    return tuple(found)


def _joined(taken: Mapping[Suspect, float], suspect: Suspect, rest: float) -> float:
    """A nuisance in the measurements as they came, from what is left of it in corrected ones."""
    before = taken.get(suspect, 0.0)
    if suspect.kind == GAIN:
        return (1 + before) * (1 + rest) - 1
    if suspect.kind == OFFSET:
        return before + (1 + taken.get(replace(suspect, kind=GAIN), 0.0)) * rest
    return before + rest


def told_apart(ruler: Ruler, what: Extended, point: Evaluation) -> tuple[Ruler, Evaluation]:
    """The ruler without suspects that the model's parameters can stand in for whole, and the point as it counts it.

    Such a suspect takes nothing from an effect's footprint that refitting does not take anyway, and would leave those
    parameters open.
    """
    rows = ruler.whole(what, point) if ruler.suspected else None
    if rows is None:
        return ruler, point
    reach = column_space(rows[:, 1:])
    shares = [_share(across(reach, column), column) for column in ruler.span.columns.T]
    kept = tuple(s for s, share in zip(ruler.suspected, shares, strict=True) if share > _ALIKE)
    ruler = ruler.with_other(suspected=kept)
    return ruler, ruler.counted(point.x, rows)


def _share(rest: Array, column: Array) -> float:
    return float(np.linalg.norm(rest) / max(float(np.linalg.norm(column)), np.finfo(float).tiny))


@dataclass(frozen=True)
class Settled:
    """A fitted model and its rulers once the nuisances beside it are known.

    Args:
        seen: estimates of every suspect.
        near: (n,) of the model, around which they are allowed for.
    """

    ruler: Ruler
    held: Ruler | None
    at: Fitted
    seen: tuple[Nuisance, ...]
    near: Array

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
    if ruler.taken and at.what.effects:
        ruler, held, at = _put_back(ruler, held, at)
    anchored, _ = taken_off(ruler, None, ruler.taken, at.what, at.point.x)
    first = Settled(anchored, held, recounted(ruler, anchored, at), (), at.point.x)
    done = first = replace(first, seen=nuisances(anchored, at.what, first.at.point))
    if first.at.point.cost > _FAR * ruler.freedom:
        return first
    for _ in range(rounds):
        if not _moved(done.ruler, done.seen):
            break
        done = _again(done)
    if done is first:
        done = replace(done, at=_lean_refit(done.ruler, done.at))
        if done.at is not first.at:
            done = replace(done, seen=nuisances(done.ruler, at.what, done.at.point))
    return done if done.at.point.cost < _EXPLAINED * ruler.freedom else first


def _put_back(ruler: Ruler, held: Ruler | None, at: Fitted) -> tuple[Ruler, Ruler | None, Fitted]:
    """Measurements as they came, with the model refitted: what a poorer model took off was physics."""
    ruler, held = taken_off(ruler, held, {}, at.what, at.point.x)
    first = ruler.evaluation(at.what, at.point.x)
    if not first.good:
        return ruler, held, at
    end = ruler.evaluation(at.what, chord_refit(ruler, at.what, first).x)
    return ruler, held, Fitted(at.what, end if end.good and end.cost < first.cost else first)


def held_beside(ruler: Ruler, held: Ruler, at: Fitted) -> Ruler:
    """What is held out without the nuisances that a model's own fit asks for, found or not.

    So each model is judged with the sensors it would have: one that explains an offset by physics is not held against
    measurements from which another model's offset was taken off.
    """
    seen = nuisances(ruler, at.what, at.point)
    if not seen:
        return held
    return _with(held, {n.suspect: n.value for n in seen if math.isfinite(n.high)})


def _again(done: Settled) -> Settled:
    """Takes off what was found, and refits."""
    what, near = done.at.what, done.at.point.x
    ruler, held = taken_off(done.ruler, done.held, {n.suspect: n.value for n in done.seen if n.found}, what, near)
    at = _lean_refit(ruler, Fitted(what, ruler.evaluation(what, near)))
    return Settled(ruler, held, at, nuisances(ruler, what, at.point), near)


def recounted(old: Ruler, new: Ruler, at: Fitted) -> Fitted:
    """The same point where only nuisances are allowed for otherwise; nothing is run that was run before."""
    rows = old.whole(at.what, at.point)
    return at if rows is None else Fitted(at.what, new.counted(at.point.x, rows))


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
    measured = ruler.measured or ruler.targets
    targets = tuple(_target(t, amounts) for t in measured)
    return ruler.with_other(targets=targets, taken=dict(amounts), measured=measured)


def _target(target: Target, amounts: Mapping[Suspect, float]) -> Target:
    """A target as it would have been measured without nuisances of these sizes."""
    if isinstance(target, LogTarget):
        late = amounts.get(Suspect(SHIFT, target.dataset, ""), 0.0)
        values, noise = _undone(target, target.dataset, amounts)
        run = target.run.experiment
        times = np.maximum(run.times + late, run.start + 1e-9 * np.arange(run.times.size))
        measured = replace(target.measured, values=values, time=target.measured.time + late)
        moved = replace(target.run, experiment=replace(run, times=times))
        return replace(target, measured=measured, noise=noise, run=moved)
    if isinstance(target, SineTarget):
        late, logs = amounts.get(Suspect(SHIFT, target.dataset, ""), 0.0), []
        for log in target.logs:
            values, noise = _undone(log, target.dataset, amounts)
            measured = replace(log.measured, values=values, time=log.measured.time + late)
            logs.append(replace(log, measured=measured, noise=noise))
        return replace(target, logs=tuple(logs))
    return target


def _undone(
    log: LogTarget | SineLog, dataset: str, amounts: Mapping[Suspect, float]
) -> tuple[Array, tuple[float, ...]]:
    """Values and noise with gains and offsets taken off."""
    names = log.measured.names
    gains = np.array([1 + amounts.get(Suspect(GAIN, dataset, name), 0.0) for name in names])
    offsets = np.array([amounts.get(Suspect(OFFSET, dataset, name), 0.0) for name in names])
    return (log.measured.values - offsets) / gains, tuple((np.array(log.noise) / gains).tolist())


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


def counting_in_words(ruler: Ruler, held: Ruler | None) -> list[str]:
    """What a reader must know of how residuals are counted: noise that is not as told, logs cut at their start."""
    told = []
    for (_, name), noise in ruler.noise.items():
        if noise.coloured:
            told.append(
                f"the noise of {name} has memory: {noise.coloured:.3g} over {1e3 * noise.memory:.2g} ms beside "
                f"{noise.white:.3g} of white noise; residuals are counted by what each sample adds to those before"
            )
        elif not noise.plain:
            told.append(f"the noise of {name} is told as {noise.told:.3g}; the logs show {noise.white:.3g}")
    for one in (ruler, *([held] if held else [])):
        for target, skip in zip(one.targets, one.skips, strict=True):
            if skip and isinstance(target, LogTarget):
                told.append(
                    f"{target.source}: the plant still moved when the log began; the first {skip:g} s are left out"
                )
    return told
