"""Gain, noise and distortion as theory says on a linear system, a cubic and a square; the pump and stepped sines."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from pysim.excitation import LeadIn, LineGrid, Multisine
from pysim.identify import SteppedSine, frequency_response, stepped_sine
from pysim.identify.multisine import (
    DropPeriods,
    distortion_p_value,
    fast_approximation,
    gain_radius,
    periods_of,
    robust_approximation,
)
from pysim.simulate import Rodas, simulate_many
from pysim.thesis import pump_model
from pysim.types import BestLinearApproximation, Distortion, Experiment, Model, SineTest
from validation.findings import Finding
from validation.multisine.systems import (
    LINES,
    PERIOD,
    cube_power,
    cubic_gain,
    gain,
    line_noise,
    linear,
    measured,
    square_power,
)

Array = NDArray[np.float64]

_RUNS = 400
_NOISE = 0.03
_SEEN = 0.05  # the level of the test for distortion
_OFFSET, _SMALL = 50.0, 0.02  # percent: a wave so small that the pump is linear
_EXACT = Rodas(rtol=1e-7, atol=1e-9)


def run() -> Iterator[Finding]:
    """Systems with known answers, then the pump."""
    yield from _linear("robust method", [_robust(seed) for seed in range(_RUNS)])
    yield from _linear("fast method", [_fast(seed) for seed in range(_RUNS)])
    yield from _textbook_variance()
    yield from _covered_cubic()
    yield from _cubic()
    yield from _square()
    pump = pump_model("free")
    yield from _pump_in_the_small(pump)
    yield from _pump_in_the_large(pump)


def _robust(seed: int) -> BestLinearApproximation:
    return robust_approximation(measured(linear, realisations=4, periods=3, noise=_NOISE, seed=seed))


def _fast(seed: int) -> BestLinearApproximation:
    return fast_approximation(measured(linear, realisations=1, periods=4, noise=_NOISE, seed=10_000 + seed))


def _linear(name: str, results: list[BestLinearApproximation]) -> Iterator[Finding]:
    """No bias, intervals that cover, no distortion."""
    title = f"linear system, {name}, {len(results)} runs"
    errors = np.array([r.gain for r in results]) - gain(LINES)
    covered = np.mean(np.abs(errors) <= [gain_radius(r) for r in results])
    spread = np.sqrt(np.mean(np.abs(errors) ** 2, axis=0) / len(results))
    bias = float(np.max(np.abs(errors.mean(axis=0)) / spread))
    yield Finding(f"{title}: largest mean error of the gain, in its own standard deviations", bias, 4, "")
    yield Finding(f"{title}: coverage of the 95 percent circles is off by", abs(float(covered) - 0.95), 0.01, "")
    for part in ("even", "odd"):
        levels = [level for level in (getattr(r, part) for r in results) if level is not None]
        alarms = float(np.mean([distortion_p_value(level) < _SEEN for level in levels]))
        yield Finding(f"{title}: share that reports {part} distortion at the 5 percent level", alarms, 0.085, "")
        mean = np.array([np.mean(level.variance) / np.mean(level.noise) for level in levels])
        yield Finding(f"{title}: mean {part} level, of the noise", float(abs(np.mean(mean))), 0.03, "")


def _textbook_variance() -> Iterator[Finding]:
    """var(G) = (sigma_n^2 / P + sigma_S^2) / M over M and P, on a cubic whose sigma_S^2 is known."""
    strength, power = 0.4, cube_power()
    distortion = strength**2 * np.array([power[k] for k in LINES.tolist()])
    for m, p in ((4, 2), (8, 2), (8, 8)):
        errors, claimed = [], []
        for seed in range(_RUNS):
            data = measured(lambda u: u + strength * u**3, realisations=m, periods=p, noise=2.0, seed=30_000 * m + seed)
            bla = robust_approximation(data, transient=DropPeriods(0))
            errors.append(np.abs(bla.gain - cubic_gain(strength)) ** 2)
            claimed.append(bla.variance)
        expected = float(np.mean((line_noise(2.0, p) + distortion) / m))
        title = f"cubic with noise, M = {m}, P = {p}, variance of the gain off (sigma_n^2 / P + sigma_S^2) / M by"
        yield Finding(f"{title}, as seen", abs(float(np.mean(errors)) / expected - 1), 0.07, "")
        yield Finding(f"{title}, as claimed", abs(float(np.mean(claimed)) / expected - 1), 0.07, "")


def _covered_cubic() -> Iterator[Finding]:
    """Intervals of a distorted gain, from few realisations and from one."""
    strength, truth = 0.4, cubic_gain(0.4)
    for name, m in (("robust method, M = 3", 3), ("robust method, M = 8", 8), ("fast method", 1)):
        inside = []
        for seed in range(_RUNS):
            data = measured(lambda u: u + strength * u**3, realisations=m, periods=3, noise=0.1, seed=50_000 * m + seed)
            bla = fast_approximation(data) if m == 1 else robust_approximation(data)
            inside.append(np.mean(np.abs(bla.gain - truth) <= gain_radius(bla)))
        title = f"cubic, {name}, {_RUNS} runs: coverage of the 95 percent circles is off by"
        yield Finding(title, abs(float(np.mean(inside)) - 0.95), 0.02, "")


def _cubic() -> Iterator[Finding]:
    strength, power = 0.4, cube_power()
    data = measured(lambda u: u + strength * u**3, realisations=1000, periods=2, noise=0.01, seed=1)
    bla = robust_approximation(data, transient=DropPeriods(0))
    error = float(np.max(np.abs(bla.gain - cubic_gain(strength)) / np.sqrt(bla.variance)))
    yield Finding(
        "cubic, 1000 realisations: gain from 1 + a (3 sigma^2 - 3/4 A^2), in standard deviations", error, 4, ""
    )
    yield _level("cubic: level on the excited lines", bla.on_lines, {k: strength**2 * v for k, v in power.items()})
    yield _level("cubic: level on free odd lines", bla.odd, {k: strength**2 * v for k, v in power.items()})
    yield _unseen("cubic: even distortion is not seen, short of p = 0.01 by", bla.even)


def _square() -> Iterator[Finding]:
    strength, power = 0.3, square_power()
    data = measured(lambda u: u + strength * u**2, realisations=1000, periods=2, noise=0.01, seed=2)
    bla = robust_approximation(data, transient=DropPeriods(0))
    error = float(np.max(np.abs(bla.gain - 1) / np.sqrt(bla.variance)))
    yield Finding("square, 1000 realisations: gain from 1, in standard deviations", error, 4, "")
    yield _level("square: level on even lines", bla.even, {k: strength**2 * v for k, v in power.items()})
    yield _unseen("square: odd distortion is not seen, short of p = 0.01 by", bla.odd)


def _level(title: str, level: Distortion | None, power: dict[int, float]) -> Finding:
    """Largest deviation of a level from the exact sum over all products that fall on its lines."""
    if level is None:
        return Finding(title, float("nan"), 0, "")
    expected = np.array([power.get(k, 0.0) for k in np.round(level.frequency * PERIOD).astype(int).tolist()])
    used = expected > 0
    off = np.abs(level.variance[used] / expected[used] - 1)
    return Finding(
        f"{title} from the sum over all products, root mean square", float(np.sqrt(np.mean(off**2))), 0.1, ""
    )


def _unseen(title: str, level: Distortion | None) -> Finding:
    p = float("nan") if level is None else distortion_p_value(level)
    return Finding(title, max(0.0, 0.01 - p) if p == p else p, 0, "")


def _driven(pump: Model, wave: Multisine, realisations: int, solver: Rodas) -> BestLinearApproximation:
    """The pump through that many realisations, logged at 250 Hz without noise."""
    times = np.arange(0, wave.duration, 1 / 250)
    experiments = [
        Experiment(
            times,
            ("alphaCMD", "alphaPercent"),
            {"alphaCMD": wave.realisation(i).signal()},
            rates={"alphaCMD_t": "alphaCMD"},
        )
        for i in range(realisations)
    ]
    records = simulate_many(pump, experiments, solver=solver)
    return robust_approximation(periods_of(records, wave.period, ("alphaCMD", "alphaPercent")))


def _wave(amplitude: float) -> Multisine:
    """As much power as a sine of that amplitude, in percent."""
    grid = LineGrid(4.0, 0.25, 30.0, "random-odd", group=3, seed=1)
    lead = LeadIn(0.2, 0.5, 2.5, 0.0)
    return Multisine(grid, seed=3, rms=amplitude / np.sqrt(2), offset=_OFFSET, periods=2, lead=lead)


def _pump_in_the_small(pump: Model) -> Iterator[Finding]:
    """Where the pump is linear every test has to find the same response."""
    bla = _driven(pump, _wave(_SMALL), 2, _EXACT)
    chosen = slice(None, None, 3)
    frequency = bla.frequency[chosen]
    test, plan = SineTest(_OFFSET, _SMALL, "alphaCMD", "alphaPercent"), SteppedSine(settle_time=1.0)
    experiments = [stepped_sine(test, f, rate_input="alphaCMD_t", plan=plan) for f in frequency.tolist()]
    sines = frequency_response(
        simulate_many(pump, experiments, solver=_EXACT), frequency.tolist(), test, onset=plan.onset
    )
    ratio = bla.gain[chosen] / (sines.gain * np.exp(1j * sines.phase))
    title = f"pump, {_SMALL:g} % around {_OFFSET:g} %: multisine against stepped sines, {frequency.size} lines"
    yield Finding(title, float(np.max(np.abs(20 * np.log10(np.abs(ratio))))), 0.01, "dB")
    yield Finding(title, float(np.max(np.abs(np.degrees(np.angle(ratio))))), 0.1, "deg")


def _pump_in_the_large(pump: Model) -> Iterator[Finding]:
    """At the bench's amplitudes distortion dominates, and it is odd: the pump's picture in one number each."""
    for amplitude in (2.5, 5.0, 10.0):
        bla = _driven(pump, _wave(amplitude), 4, Rodas(rtol=1e-5, atol=1e-5))
        assert bla.on_lines is not None
        assert bla.odd is not None
        assert bla.even is not None
        title = f"pump, multisine with the power of a sine of {amplitude:g} %"
        share = 10 * np.log10(float(np.mean(bla.on_lines.variance / np.abs(bla.gain) ** 2)))
        yield Finding(f"{title}: mean distortion on the excited lines, of the response", share, -10, "dB")
        more = 10 * np.log10(float(np.mean(bla.even.variance) / np.mean(bla.odd.variance)))
        yield Finding(f"{title}: even distortion, of the odd", more, -6, "dB")
        apart = 10 * np.log10(float(np.mean(bla.odd.variance) / np.mean(bla.on_lines.variance)))
        yield Finding(f"{title}: free odd lines against the scatter of realisations, apart", abs(apart), 3, "dB")
