"""Finds the nuisances that the data hold, and takes them off the measurements."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.blame import PLAUSIBLE, Blame, Evidence
from pysim.diagnose.descent import mean_square
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.nuisance import GAIN, SHIFT, Suspect, suspects, undisturbed
from pysim.diagnose.refit import refit
from pysim.diagnose.residuals import Ruler
from pysim.diagnose.screen import across, column_space
from pysim.diagnose.secants import with_secants
from pysim.diagnose.subject import Extended
from pysim.diagnose.wrong_starts import answers, restless_beside, skips_beside, started
from pysim.identify.greybox.residuals import Point

Array = NDArray[np.float64]

# Share of a nuisance that parameters have to leave for it to be told from them.
_ALIKE = 1e-2
# Fall of the sum of squares from which another refit is worth its runs.
_WORTH = 1.0
# Mean square from which a model is too far off for saying who is to blame.
_OFF = 2.0
# Standard deviations that noise alone seldom leaves more of.
_RARE = 3.1
# Standard deviation from which the data leave a direction open, in units of the search.
_OPEN = 0.25
# Of a step by slopes, that are tried.
_SHARES = (1.0, 0.5, 0.25)
# Refits at most until the blamed are the same again, and until shapes and shifts of nuisances are.
_ROUNDS, _CLOSER = 3, 4


@dataclass(frozen=True)
class Nuisance:
    """What the measurements say of one nuisance that is allowed for.

    Args:
        suspect: which.
        value: share beyond 1, the signal's unit, or s.
        low, high: of the 95 percent interval.
    """

    suspect: Suspect
    value: float
    low: float
    high: float


def nuisances(ruler: Ruler, point: Point) -> tuple[Nuisance, ...]:
    """Estimates of every nuisance that the ruler allows for, at a fitted point.

    The intervals allow for what the parameters of the model can take over.

    Args:
        point: of the ruler.
    """
    if not ruler.suspected:
        return ()
    rows = ruler.whole(point)
    reach = column_space(rows[:, 1:])
    usual = np.array([s.width for s in ruler.suspected])
    columns = across(reach, across(reach, ruler.span.columns * usual))
    doubt = np.linalg.inv(columns.T @ columns + np.eye(usual.size))
    values = usual * (doubt @ (columns.T @ rows[:, 0]))
    spread = usual * np.sqrt(np.diag(doubt) * max(1.0, point.cost / max(ruler.freedom - point.x.size, 1)))
    reached = zip(ruler.suspected, values.tolist(), (1.96 * spread).tolist(), strict=True)
    return tuple(Nuisance(suspect, value, value - half, value + half) for suspect, value, half in reached)


def evidence(ruler: Ruler, point: Point, changes: Sequence[Array] = ()) -> Evidence:
    """What speaks for nuisances and effects at a fitted point.

    Args:
        ruler: that allows for every suspect.
        changes: m of (n_r,) of the residuals by effects, where no nuisance is allowed for.
    """
    rows = ruler.whole(point)
    both = np.column_stack(changes) if len(changes) else np.zeros((rows.shape[0], 0))
    columns = ruler.span.columns if ruler.suspected else np.zeros((rows.shape[0], 0))
    return Evidence.of(ruler.suspected, columns, rows[:, 0], both, column_space(rows[:, 1:]))


def told_apart(ruler: Ruler, point: Point) -> tuple[Ruler, Point]:
    """The ruler without suspects that the model's parameters can stand in for whole, and the point as it counts it.

    Such a suspect takes nothing from an effect's footprint that refitting does not take anyway, and would leave those
    parameters open.
    """
    if not ruler.suspected:
        return ruler, point
    rows = ruler.whole(point)
    reach = column_space(rows[:, 1:])
    shares = [_share(across(reach, column), column) for column in ruler.span.columns.T]
    ruler = ruler.only([s for s, share in zip(ruler.suspected, shares, strict=True) if share > _ALIKE])
    return ruler, ruler.counted(point.x, rows)


def _share(rest: Array, column: Array) -> float:
    return float(np.linalg.norm(rest) / max(float(np.linalg.norm(column)), np.finfo(float).tiny))


def blamed(ruler: Ruler, point: Point) -> Blame:
    """Who is to blame at a fitted point; every suspect a little where the model is so far off that sizes tell nothing.

    Args:
        ruler: that allows for every suspect.
    """
    if is_off(ruler, point):
        return Blame(frozenset(ruler.suspected), point.cost, 0.0)
    return evidence(ruler, point).alone()


def is_off(ruler: Ruler, point: Point) -> bool:
    """Whether much more than noise is left with every suspect allowed for: straight lines do not reach the truth."""
    return point.cost > _OFF * ruler.freedom


def as_noise(ruler: Ruler, point: Point) -> bool:
    """Whether no more is left than noise leaves in 999 of 1000 cases: no other start would end much lower."""
    freedom = ruler.freedom - point.x.size
    return point.cost < freedom + _RARE * math.sqrt(2 * freedom)


def implausible(ruler: Ruler, point: Point) -> tuple[Suspect, ...]:
    """Nuisances that a model far off bends to sizes that no sensor and no clock has, so as to hide what it lacks."""
    if not is_off(ruler, point):
        return ()
    return tuple(n.suspect for n in nuisances(ruler, point) if abs(n.value) > PLAUSIBLE * n.suspect.width)


@dataclass(frozen=True)
class Settled:
    """A fitted model with the nuisances that are to blame beside it, and no others.

    Args:
        whole: the model where every suspect is allowed for, by
        ruler: which has the nuisances' shapes from that model.
        at: refitted where only those to blame are allowed for, by
        lean: the ruler.
        seen: their sizes.
    """

    whole: Fitted
    ruler: Ruler
    at: Fitted
    lean: Ruler
    seen: tuple[Nuisance, ...]

    @staticmethod
    def as_is(ruler: Ruler, at: Fitted) -> Settled:
        """A model that nothing was refitted for."""
        return Settled(at, ruler, at, ruler, ())

    @property
    def amounts(self) -> dict[Suspect, float]:
        """Sizes to take off what was measured."""
        return {n.suspect: n.value for n in self.seen}


def settled(ruler: Ruler, at: Fitted) -> Settled:
    """Finds who is to blame beside a model that was refitted with every suspect allowed for, and refits with only them.

    A suspect that nothing speaks for would make parameters and effects less certain than they are, and would take its
    share of an effect that looks like it.
    """
    ruler, whole = _nearer(ruler, at)
    what, x, rows = at.what, whole.point.x, ruler.whole(whole.point)
    blame, lean = blamed(ruler, whole.point), ruler
    for _ in range(0 if is_off(ruler, whole.point) else _ROUNDS):
        lean = ruler.only(blame.suspects)
        x, rows = _lean_refit(lean, what, x, rows)
        before, blame = blame, evidence(ruler, ruler.counted(x, rows)).alone()
        if blame.suspects == before.suspects:
            break
    return _settled(ruler, whole, lean, x, rows)


def settled_before(ruler: Ruler, at: Fitted, x: Array, suspected: Sequence[Suspect]) -> Settled:
    """The same where it was found out earlier, bit for bit.

    Args:
        x: (n,) where the refit ended.
        suspected: who was to blame.
    """
    ruler, whole = _nearer(ruler, at)
    lean = ruler.only(suspected)
    moved = not np.array_equal(x, whole.point.x)
    rows = lean.whole(lean.evaluation(at.what, x)) if moved else ruler.whole(whole.point)
    return _settled(ruler, whole, lean, x, rows)


def _settled(ruler: Ruler, whole: Fitted, lean: Ruler, x: Array, rows: Array) -> Settled:
    if lean.has_events(whole.what, x):
        rows = with_secants(lean, whole.what, x, rows)
    at = replace(whole, point=lean.counted(x, rows))
    return Settled(whole, ruler, at, lean, () if is_off(ruler, whole.point) else nuisances(lean, at.point))


def _nearer(ruler: Ruler, at: Fitted) -> tuple[Ruler, Fitted]:
    """With the shapes of the nuisances from a model, and without starts that are wrong beside it.

    An effect that moves the place of rest has the plant start where the model does not. Shapes taken from a model that
    was far off fit what they should not, and a long shift of clocks is no straight line: refits until neither matters,
    or until it is plain that the misfit is another.
    """
    for _ in range(_CLOSER):
        shifts = {n.suspect: n.value for n in nuisances(ruler, at.point) if n.suspect.kind == SHIFT}
        off = is_off(ruler, at.point)
        moved = ruler if off else ruler.moved(shifts)
        near = answers(moved, at.what, at.point.x)
        if near is None:
            break
        closer = moved.with_other(near=tuple(near), skips=skips_beside(moved, near))
        first = closer.evaluation(at.what, at.point.x)
        if not first.good:
            break
        restless = restless_beside(closer, first)
        if restless != closer.skips and not is_off(closer, first):
            closer = closer.with_other(skips=restless)
            first = closer.evaluation(at.what, at.point.x)
        near_enough = abs(first.cost - at.point.cost) < _WORTH * mean_square(first) or (off and is_off(closer, first))
        same = closer.skips == ruler.skips and near_enough
        ruler, at = closer, replace(at, point=first if same else refit(closer, at.what, first))
        if same:
            break
    return ruler, at


def held_beside(ruler: Ruler, held: Ruler, at: Fitted) -> Ruler:
    """What is held out without the nuisances that a model's own fit asks for.

    So each model is judged with the sensors it would have: one that explains an offset by physics is not held against
    measurements from which another model's offset was taken off.

    Args:
        ruler: that allows for those.
    """
    return corrected(held, {n.suspect: n.value for n in nuisances(ruler, at.point)})


def leaning(lean: Ruler, at: Fitted) -> Array:
    """Where (n,) a model's refit would end with fewer nuisances allowed for, by its slopes.

    What the data leave open stays as it is. Slopes reach only so far: of a step that makes the fit worse half is taken,
    and so on, or none.

    Args:
        lean: that allows for those.
        at: as it counts the point.
    """
    x = at.point.x
    rows = np.vstack([at.point.jacobian, np.eye(x.size) / _OPEN])
    step = np.linalg.lstsq(rows, -np.concatenate([at.point.residual, np.zeros(x.size)]), rcond=None)[0]
    for share in _SHARES:
        moved = np.clip(x + share * step, *at.what.space.bounds())
        residual = lean.at(at.what, moved)
        if residual is not None and float(residual @ residual) <= at.point.cost:
            return moved
    return x


def corrected(ruler: Ruler, amounts: Mapping[Suspect, float]) -> Ruler:
    """The ruler of what would have been measured without nuisances of these sizes.

    A gain that is taken off a signal is taken off its noise.
    """
    if not amounts:
        return ruler
    gains = {(s.dataset, s.signal): 1 + amount for s, amount in amounts.items() if s.kind == GAIN}
    noise = {column: one.over(gains.get(column, 1.0)) for column, one in ruler.noise.items()}
    return ruler.with_other(targets=undisturbed(ruler.targets, amounts), noise=noise)


def recounted(old: Ruler, new: Ruler, at: Fitted) -> Fitted:
    """The same point where only nuisances are allowed for otherwise; it is run again where other rows count."""
    if old.skips != new.skips:
        return replace(at, point=new.evaluation(at.what, at.point.x))
    return replace(at, point=new.counted(at.point.x, old.whole(at.point)))


def _lean_refit(ruler: Ruler, what: Extended, x: Array, rows: Array) -> tuple[Array, Array]:
    """The best point (n,), with residuals and slopes (n_r, 1 + n) as measured; the same where it is that already."""
    first = ruler.counted(x, rows)
    reach = column_space(first.jacobian)
    if float(np.sum((reach.T @ first.residual) ** 2)) < _WORTH:
        return x, rows
    end = ruler.evaluation(what, refit(ruler, what, first, rounds=3).x)
    return (end.x, ruler.whole(end)) if end.good and end.cost < first.cost else (x, rows)


def allowing(ruler: Ruler, held: Ruler | None, what: Extended, x: Array) -> tuple[Ruler, Ruler | None]:
    """Rulers that allow for every nuisance: gains, offsets and shifts in what is fitted, wrong starts in all.

    What is held out takes no part in telling nuisances: it is counted as it is once they are corrected.

    Args:
        x: (n,) of the model, near the plant; the rulers stay as they are where it cannot be simulated there.
    """
    near = answers(ruler, what, x)
    if near is not None:
        everyone = suspects(ruler.targets)
        ruler = ruler.with_other(suspected=everyone, near=tuple(near), skips=skips_beside(ruler, near))
    return ruler, None if held is None else started(held, what, x)
