"""Is anything missing at all: what noise alone does to the best gain of a catalogue, and to what no effect explains."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import stats
from scipy.fft import dct

from pysim.diagnose.noise import white
from pysim.diagnose.residuals import Ruler
from pysim.diagnose.screen import Footprint, column_space
from pysim.diagnose.whiten import Innovations
from pysim.identify.greybox.residuals import Point
from pysim.identify.greybox.stepped_sines import SteppedSines
from pysim.identify.greybox.time_log import TimeLog

Array = NDArray[np.float64]

# Chance of naming something where nothing is missing, over the whole catalogue.
ALARM = 0.005
# Hz, between the bands in which logs over time are summed up.
BANDS = (0.0, 0.25, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, math.inf)
# Share of a band's noise power by which the noise may be other than estimated: of white noise, and of noise with
# memory, whose two numbers come from a limited stretch of it.
_WHITE_DOUBT, _COLOURED_DOUBT = 0.03, 0.15
# s between the lags of the command that residuals are held against, and their number.
_LAG, _LAGS = 0.02, 8
# Draws beyond a height from which they are counted rather than extrapolated.
_COUNTED = 10
# A part is told where noise alone would make any part stick out so far with this chance.
_TELL = 0.02


@dataclass(frozen=True)
class Chance:
    """What the best gain of the whole catalogue would be where nothing is missing.

    Args:
        limit: exceeded with the probability ALARM.
        p_value: of the best gain seen.
    """

    limit: float
    p_value: float


def chance(footprints: Sequence[Footprint], *, scale: float, seed: int, draws: int = 4000) -> Chance:
    """Parametric bootstrap on the projected footprints: noise is drawn along them, and the best gain is taken.

    The gains depend on the noise through its products with the footprints only, which are normal with the footprints'
    own products as covariance; nothing has to be simulated.

    Args:
        scale: variance of the noise in units of that stated.
    """
    if not footprints:
        return Chance(0.0, 1.0)
    columns = np.array([f.left / math.sqrt(f.size) for f in footprints])
    values, vectors = np.linalg.eigh(columns @ columns.T)
    root = vectors * np.sqrt(np.clip(values, 0.0, None))
    drawn = np.random.default_rng(seed).standard_normal((draws, values.size)) @ root.T
    signed = np.array([any(p.min < (p.off or 0.0) for p in f.effect.strengths) for f in footprints])
    gains = np.where(signed | (drawn < 0), drawn, 0.0) ** 2
    best = scale * gains.max(axis=1)
    limit = float(np.quantile(best, 1 - ALARM))
    beyond = int(np.sum(best >= max(f.gain for f in footprints)))
    return Chance(limit, (beyond + 1) / (draws + 1))


@dataclass(frozen=True)
class Leftover:
    """Whether residuals hold more than noise, whatever it may be.

    Args:
        p_value: chance of something as unlikely as what is seen, by noise alone.
        where: parts that stick out, the least likely first.
    """

    p_value: float
    where: tuple[str, ...]


@dataclass(frozen=True)
class _Part:
    """Rows of turned residuals that are summed up: a band of a signal, or a harmonic of stepped sines."""

    labels: tuple[str, ...]
    rows: NDArray[np.int64]
    doubt: float


def leftover(ruler: Ruler, point: Point, *, seed: int = 0, draws: int = 2000) -> Leftover:
    """Sums of squares by signal and band or harmonic, and products with the command, against what noise alone does.

    A misfit of a few among thousands of samples does not move their total. It does stick out where it sits: at low
    frequencies, at even harmonics, or along the command. The noise is drawn as it is left once the model's parameters
    and the nuisances have taken what they can, so that no part is expected to hold more than that.

    Args:
        point: refitted, with slopes.
    """
    return Expected.of(ruler, point.jacobian, seed=seed, draws=draws).beside(point.residual)


@dataclass(frozen=True)
class Expected:
    """What noise alone leaves in each part of the residuals once a model was refitted.

    Args:
        ruler: that counts them.
        reach: (n_r, m) orthonormal columns of all that parameters take.
        parts: what is summed up.
        groups: parts that go together, by name.
        drawn: (draws, n_parts) sums of squares of noise.
        along: (n_r, k) orthonormal columns along the command and its powers, of which nothing is taken.
    """

    ruler: Ruler
    reach: Array
    parts: tuple[_Part, ...]
    groups: Mapping[str, Sequence[int]]
    drawn: Array
    along: Array

    @staticmethod
    def of(ruler: Ruler, slopes: Array, *, seed: int = 0, draws: int = 2000) -> Expected:
        """For a model with slopes (n_r, n), as the ruler counts them."""
        reach = column_space(slopes)
        parts, turned = _turned(ruler, reach)
        drawn = _draws(parts, turned, np.random.default_rng(seed), draws)
        return Expected(ruler, reach, tuple(parts), _groups(parts), drawn, _along_command(ruler, reach))

    def beside(self, residual: Array) -> Leftover:
        """What residuals (n_r,) hold more than that."""
        left = residual - self.reach @ (self.reach.T @ residual)
        turned = _turned(self.ruler, left[:, None])[1][:, 0]
        seen = np.array([[turned[part.rows] @ turned[part.rows] for part in self.parts]])
        tall = [_height(seen[:, list(members)], self.drawn[:, list(members)]) for members in self.groups.values()]
        top, tops = np.array([t for t, _ in tall]), np.max([many for _, many in tall], axis=0)
        p_parts = beyond(float(top.max()), tops)
        p_command = self._command(residual)
        limit, names = np.quantile(tops, 1 - _TELL), list(self.groups)
        where = ["along the command and its powers"] if p_command < _TELL else []
        where += [names[k] for k in np.argsort(-top) if top[k] > limit]
        return Leftover(1 - (1 - min(p_parts, p_command)) ** 2, tuple(where))

    def _command(self, residual: Array) -> float:
        """Chance of as much along the command."""
        if not self.along.shape[1]:
            return 1.0
        doubts = [_COLOURED_DOUBT if noise.coloured else _WHITE_DOUBT for noise in self.ruler.noise.values()]
        gain = float(np.sum((self.along.T @ residual) ** 2)) / (1 + 2 * max(doubts, default=_WHITE_DOUBT))
        return float(stats.chi2.sf(gain, self.along.shape[1]))


def beyond(height: float, drawn: Array) -> float:
    """Chance of so large a maximum, from draws (n,) of it; further out than a few of these by their Gumbel tail.

    Maxima of many parts are nearly Gumbel's (Gumbel 1958, Statistics of Extremes); its tail is heavier than the normal
    one of each part, so that what it calls unlikely is.
    """
    seen = int(np.sum(drawn >= height))
    if seen >= _COUNTED:
        return (1 + seen) / (1 + drawn.size)
    scale = float(drawn.std()) * math.sqrt(6) / math.pi
    place = (height - float(drawn.mean())) / max(scale, 1e-12) + float(np.euler_gamma)
    return min(-math.expm1(-math.exp(-place)), (1 + seen) / (1 + drawn.size))


def _turned(ruler: Ruler, rows: Array) -> tuple[list[_Part], Array]:
    """Logs over time turned to frequencies, with the parts to sum up; an orthonormal map."""
    found, place = np.array(rows), 0
    parts: list[_Part] = []
    for target, made in zip(ruler.targets, ruler.whitenings, strict=True):
        own = np.arange(place, place + made.size)
        place += made.size
        if isinstance(target, TimeLog) and isinstance(made, Innovations):
            for j in range(made.scale.shape[1]):
                rows_of = own[j :: made.scale.shape[1]]
                found[rows_of] = dct(found[rows_of], type=2, norm="ortho", axis=0)
                parts += _bands(ruler, target, made, j, rows_of)
        elif isinstance(target, SteppedSines):
            parts += _orders(ruler, target, own)
        else:
            parts.append(_Part(("tables",), own, _WHITE_DOUBT))
    return parts, found


def _bands(ruler: Ruler, target: TimeLog, made: Innovations, j: int, rows: NDArray[np.int64]) -> Iterator[_Part]:
    interval = float(np.median(np.diff(target.measured.time)))
    frequency = np.arange(rows.size) / (2 * interval * rows.size)
    name = target.measured.names[j]
    noise = ruler.noise.get((target.dataset, name), white(target.noise[j]))
    for low, high in itertools.pairwise(BANDS):
        inside = (frequency >= low) & (frequency < high)
        if inside.any():
            middle = frequency[inside][[inside.sum() // 2]]
            share = 1 - noise.white**2 / float(noise.spectrum(middle, interval)[0])
            band = f"{name} of logs over time, {low:g} to {min(high, 0.5 / interval):g} Hz"
            yield _Part((band, f"{name} of logs over time"), rows[inside], _WHITE_DOUBT + _COLOURED_DOUBT * share)


def _orders(ruler: Ruler, target: SteppedSines, rows: NDArray[np.int64]) -> Iterator[_Part]:
    """Mean and harmonics of the test at one offset and amplitude, over all frequencies."""
    collected: dict[tuple[str, int], list[int]] = {}
    place = 0
    for log in target.logs:
        names = log.measured.names
        for row in range(2 * log.count + 1):
            for name in names:
                collected.setdefault((name, (row + 1) // 2), []).append(int(rows[place]))
                place += 1
    sine = target.logs[0].sine
    for (name, order), own in collected.items():
        noise = ruler.noise.get((target.dataset, name))
        share = 0.0 if noise is None else (noise.coloured / noise.deviation) ** 2
        what = "mean" if order == 0 else f"harmonic {order}" if order > 1 else "fundamental"
        told = f"{what} of {name} under stepped sines"
        each = f"{told} of {sine.amplitude:g} around {sine.offset:g}"
        yield _Part((each, told), np.array(own), _WHITE_DOUBT + _COLOURED_DOUBT * share)


def _groups(parts: Sequence[_Part]) -> dict[str, list[int]]:
    """Every part, and those that go together."""
    found: dict[str, list[int]] = {}
    for k, part in enumerate(parts):
        for label in part.labels:
            found.setdefault(label, []).append(k)
    return found


def _draws(parts: Sequence[_Part], reach: Array, rng: np.random.Generator, draws: int) -> Array:
    """Sums of squares of noise of variance 1 in each part, (draws, n_parts), once `reach` (n_r, m) has taken its share.

    Exact without drawing every residual: within a part, noise outside of what the columns span there is chi-square,
    and inside it are as many normal numbers as columns.
    """
    m = reach.shape[1]
    inside, triangles, outside = [], [], []
    for part in parts:
        rank = min(m, part.rows.size)
        triangles.append(np.asarray(np.linalg.qr(reach[part.rows], mode="r")))
        inside.append(rng.standard_normal((draws, rank)))
        rest = part.rows.size - rank
        outside.append(rng.chisquare(rest, draws) if rest else np.zeros(draws))
    taken = sum((a @ r for a, r in zip(inside, triangles, strict=True)), np.zeros((draws, m)))
    sums = []
    for part, a, r, rest in zip(parts, inside, triangles, outside, strict=True):
        left = a - taken @ r.T
        size = np.exp(part.doubt * rng.standard_normal(draws))
        sums.append(size * (np.sum(left**2, axis=1) + rest))
    return np.column_stack(sums)


def _height(seen: Array, drawn: Array) -> tuple[float, Array]:
    """How far the sum of some parts sticks out, and how far noise alone does, in its standard deviations.

    The cube root of a chi-square is nearly normal (Wilson and Hilferty 1931, PNAS 17:684).
    """
    ours, theirs = np.cbrt(seen.sum(axis=1)), np.cbrt(drawn.sum(axis=1))
    middle, spread = float(theirs.mean()), max(float(theirs.std()), 1e-12)
    return float((ours[0] - middle) / spread), (theirs - middle) / spread


def _along_command(ruler: Ruler, reach: Array) -> Array:
    """Orthonormal columns (n_r, k) along the commands of logs over time, of which `reach` takes nothing."""
    found = [np.zeros((reach.shape[0], 0))]
    for rows, columns in _command_columns(ruler):
        sizes = np.linalg.norm(columns, axis=0)
        own = _orthonormal(columns[:, sizes > 0] / sizes[sizes > 0], 1e-6)
        placed = np.zeros((reach.shape[0], own.shape[1]))
        placed[rows] = own
        found.append(placed)
    along = np.concatenate(found, axis=1)
    return _orthonormal(along - reach @ (reach.T @ along), 1e-3)


def _orthonormal(columns: Array, floor: float) -> Array:
    """Columns that span what these do, without directions in which hardly anything happens."""
    values, vectors = np.linalg.eigh(columns.T @ columns)
    kept = values > floor
    return np.asarray(columns @ (vectors[:, kept] / np.sqrt(values[kept])))


def _command_columns(ruler: Ruler) -> Iterator[tuple[NDArray[np.int64], Array]]:
    """Per target and signal the rows and, whitened, lags of the command, its square and cube in them."""
    place = 0
    for target, made in zip(ruler.targets, ruler.whitenings, strict=True):
        begin, place = place, place + made.size
        if not (isinstance(target, TimeLog) and isinstance(made, Innovations)):
            continue
        shaped, signals = _lagged(target), made.scale.shape[1]
        if shaped.shape[1]:
            rows = made.of(np.repeat(shaped[:, None, :], signals, axis=1).reshape(-1, shaped.shape[1]))
            for j in range(signals):
                yield np.arange(begin + j, place, signals), rows[j::signals]


def _lagged(target: TimeLog) -> Array:
    """Commands at some lags over time, (n_t, n), of size one at most."""
    run, columns = target.run.experiment, []
    for signal in run.inputs.values():
        for lag in range(_LAGS):
            value = signal.value(np.maximum(run.times - lag * _LAG, run.start))
            value = value / (float(np.abs(value).max()) or 1.0)
            columns += [value**power for power in ((1, 2, 3) if lag % 4 == 0 else (1,))]
    return np.column_stack(columns) if columns else np.zeros((run.times.size, 0))
