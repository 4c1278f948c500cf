"""Design of the next experiment: tests that separate two models which explain the present data equally well.

Each model in turn is taken as the truth. The other one is refitted, to first order, to the present data and the new
test together. The gain of the test is the smaller one of the two sums of squares that remain.

Source: Atkinson and Fedorov 1975, Biometrika 62:57 (T-optimality), with the information of the present data added.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pysim.diagnosis import rivals
from pysim.diagnosis.candidate_tests import CandidateTest, candidate_tests, plan_text
from pysim.diagnosis.refit import FinalFit
from pysim.diagnosis.session import Session
from pysim.diagnosis.settings import TestSettings
from pysim.identify.greybox import Simulation
from pysim.identify.greybox.observation import Run, Simulated
from pysim.identify.greybox.runs import simulate_runs
from pysim.identify.greybox.time_log import TimeLog
from pysim.simulate import Esdirk, Rodas, simulate, simulate_many
from pysim.types import BadInput, Experiment, MeasuredSignal, NextTest, Outcome, Record

Array = NDArray[np.float64]
Signals = Sequence[MeasuredSignal]
Tests = Sequence[CandidateTest]
Plan = Sequence[tuple[int, int]]  # number of a test, and how often it is run
# Per test: signal -> Gram matrix (1 + n, 1 + n) of the difference of the two models and of the second model's Jacobian,
# both over the noise; and the same with the first model's Jacobian. Empty for a test that cannot be simulated.
Table = Sequence[Mapping[str, tuple[Array, Array]]]

# Relative tolerances of preliminary runs, and of runs that are compared, whose errors must not count as evidence.
_COARSE, _FINE = 1e-5, 1e-6
# Units of states that no sensor can measure, such as those of a controller.
_WITHIN = ("", "1", "%", "%/s")


def next_test(
    session: Session, one: FinalFit, other: FinalFit, settings: TestSettings | None = None
) -> NextTest | None:
    """A short set of tests that is expected to separate two refitted models; None if no set does.

    The signals logged so far are preferred. If they are not enough, one more is asked for, an output of the model
    rather than a state. Size and autocorrelation of the noise are those of what the better model leaves.

    Args:
        one, other: refitted models, with exact Jacobians at their best points.
    Raises:
        BadInput: no output was fitted over time, there is not exactly one command, or the command never moves.
    """
    settings = settings or TestSettings()
    settings = replace(settings, enough=_colour(one, other) * settings.enough)
    noise = _levels(one, other)
    logged = _logged(session, noise)
    tests = candidate_tests(
        session.dataset, lambda run: _settled(session, one, logged, run, settings.still), session.model, settings
    )
    outputs, states = loggable(session, one, other, tests, settings)
    signals = (*logged, *outputs, *states)
    noise |= {signal.name: signal.deviation for signal in (*outputs, *states)}
    table, known = _table(session, (one, other), tests, signals, noise), (_known(other), _known(one))
    own, seconds = tuple(signal.name for signal in logged), [test.seconds for test in tests]
    best: tuple[float, Plan, Sequence[str]] = (0.0, (), ())
    for tier in ([own], *([(*own, s.name) for s in new] for new in (outputs, states))):
        for names in tier:
            gain, plan = cheapest(seconds, table, names, known, settings)
            if gain > best[0] * (1 if best[0] < settings.enough else 4):
                best = gain, plan, names
        if best[0] >= settings.enough:
            chosen = [test for k, count in best[1] for test in tests[k].repeated(count)]
            return _described(session, (one, other), chosen, [s for s in signals if s.name in best[2]], best[0])
    return None


def _levels(*fits: FinalFit) -> dict[str, float]:
    """Output -> standard deviation of its residual in its unit, the smallest one of the models."""
    found: dict[str, float] = {}
    for fit in fits:
        channels = fit.candidate.residuals(fit.simulation).channels
        for (_, name), level in zip(channels, fit.point.levels.tolist(), strict=True):
            found[name] = min(level, found.get(name, math.inf))
    return found


def _logged(session: Session, level: Mapping[str, float]) -> tuple[MeasuredSignal, ...]:
    """Compared outputs with their noise: as specified, or else the residual's standard deviation less rounding."""
    found = [signal for signal in session.dataset.signals if signal.name in level]
    seen = [math.sqrt(max(level[s.name] ** 2 - s.deviation**2, 0.0)) if s.noise is None else s.noise for s in found]
    return tuple(replace(signal, noise=noise) for signal, noise in zip(found, seen, strict=True))


def _colour(one: FinalFit, other: FinalFit) -> float:
    """lambda of the present data, by which colour inflates the variance of a gain; expected of the new test too."""
    own, its = rivals.of(one), rivals.of(other)
    return rivals.effective(own, its.residual - own.residual) if np.array_equal(own.series, its.series) else 1.0


def _known(fit: FinalFit) -> Array:
    """(n, n) information matrix: of the present data on the parameters, of the priors alone on the sensor errors."""
    n, size = fit.point.x.size, fit.candidate.size
    whole = np.diag([0.0] * n + [one.prior_sd**-2 for one in fit.candidate.nuisances]).reshape(size, size)
    whole[:n, :n] = fit.point.jacobian.T @ fit.point.jacobian
    return whole


def _overrides(session: Session, fit: FinalFit) -> dict[str, float]:
    return {**session.data.overrides, **fit.candidate.space.values(fit.point.x)}


def _settled(session: Session, fit: FinalFit, signals: Signals, run: Experiment, still: float) -> float:
    """Time in s after which every signal stays within `still` times its noise of its end; the run's end on failure."""
    if not signals:
        raise BadInput("a next test needs an output in a log over time to go by; log one")
    asked = replace(run, record=tuple(s.variable for s in signals), overrides=_overrides(session, fit))
    record = simulate(fit.candidate.model, asked, solver=Rodas(_COARSE, _COARSE), check=False)
    if record.outcome is not Outcome.DONE or not np.isfinite(record.values).all():
        return float(run.times[-1])
    away = np.abs(record.values - record.values[-1]) > [still * s.deviation for s in signals]
    last = np.flatnonzero(away.any(axis=1))
    return float(record.time[last[-1]]) if last.size else 0.0


def loggable(
    session: Session, one: FinalFit, other: FinalFit, tests: Tests, settings: TestSettings
) -> tuple[tuple[MeasuredSignal, ...], tuple[MeasuredSignal, ...]]:
    """Outputs, and states in physical units, that could be logged too: both models have them, and they move.

    Their noise is taken as a share of their range, and well above the integration error, which is no evidence.
    """
    model, known = session.model, {signal.variable for signal in session.dataset.signals}
    shared = {v.name for v in one.candidate.model.variables} & {v.name for v in other.candidate.model.variables}
    outputs = [v.name for v in model.variables if v.causality == "output"]
    states = [name for name in model.abilities.states if model[name].unit not in _WITHIN]
    names = [name for name in dict.fromkeys([*outputs, *states]) if name in shared - known]
    if not names:
        return (), ()
    runs = [test.experiment(one.candidate.model, tuple(names), _overrides(session, one)) for test in tests]
    ends = []
    for rtol in (_COARSE, _FINE):
        records = simulate_many(one.candidate.model, runs, solver=Rodas(rtol=rtol, atol=rtol))
        ends.append(np.concatenate([record.values for record in records]))
        if any(r.outcome is not Outcome.DONE for r in records) or not np.isfinite(ends[-1]).all():
            return (), ()
    span, error = np.ptp(ends[1], axis=0), np.sqrt(np.mean((ends[0] - ends[1]) ** 2, axis=0))
    noise = np.maximum(settings.unlogged * span, settings.errors * error)
    found = [
        MeasuredSignal(name, "output", model[name].unit, name, name, noise=float(own))
        for name, own, wide in zip(names, noise, span, strict=True)
        if 0 < own < settings.readable * wide
    ]
    return tuple(s for s in found if s.name in outputs), tuple(s for s in found if s.name not in outputs)


def _table(
    session: Session, fits: tuple[FinalFit, FinalFit], tests: Tests, signals: Signals, noise: Mapping[str, float]
) -> Table:
    """The Gram matrices of each test and signal, see Table."""
    table: list[dict[str, tuple[Array, Array]]] = []
    read = [_readings(session, fit, tests, signals) for fit in fits]
    for test, first, second in zip(tests, *read, strict=True):
        table.append({})
        if first is None or second is None:
            continue
        apart = first[:, :, :1] - second[:, :, :1]
        for j, signal in enumerate(signals):
            own = [np.hstack([apart[:, j], slopes[:, j, 1:]]) / noise[signal.name] for slopes in (second, first)]
            of_second, of_first = (test.counted(rows) for rows in own)
            table[-1][signal.name] = of_second.T @ of_second, of_first.T @ of_first
    return table


def _readings(session: Session, fit: FinalFit, tests: Tests, signals: Signals) -> list[Array | None]:
    """Per test the simulated readings and their derivatives by all free numbers (n_t, n_y, 1 + n); None if it fails."""
    candidate, simulation = fit.candidate, Simulation(Esdirk(_FINE, _FINE), workers=session.workers)
    variables, overrides = tuple(s.variable for s in signals), dict(session.data.overrides)
    runs = [Run(str(k), t.experiment(candidate.model, variables, overrides)) for k, t in enumerate(tests)]

    def simulated(some: Sequence[Run]) -> tuple[Simulated, ...]:
        none = [None] * len(some)
        return simulate_runs(candidate.model, candidate.space, some, fit.point.x, none, simulation).simulated

    names, units, ones = tuple(s.name for s in signals), tuple(s.unit for s in signals), (1.0,) * len(signals)
    count = len(candidate.nuisances)

    def read(run: Run, answer: Simulated) -> Array:
        record = Record(run.experiment.times, answer.values, names, units)
        log = TimeLog(session.dataset.name, run.record, "", "fit", record, ones, ones, run, index=0)
        errors = log.nuisance_columns([answer], candidate.nuisances).reshape(*answer.values.shape, count)
        values = answer.values + errors @ fit.point.carried.nuisances
        return np.concatenate([values[:, :, None], answer.slopes, errors], axis=2)

    every = simulated(runs) or [next(iter(simulated([run])), None) for run in runs]
    return [None if answer is None else read(run, answer) for run, answer in zip(runs, every, strict=True)]


def remaining(products: Array, known: Array) -> float:
    """Sum of squares over the noise that is left once a model is refitted, linearly, to the new and the present data.

    Args:
        products: (1 + n, 1 + n) Gram matrix of the models' difference, first, and of the model's Jacobian.
        known: (n, n) information of the present data.
    """
    slope = products[1:, 0]
    return float(products[0, 0] - slope @ np.linalg.lstsq(known + products[1:, 1:], slope, rcond=1e-12)[0])


def cheapest(
    seconds: Sequence[float], table: Table, names: Sequence[str], known: tuple[Array, Array], settings: TestSettings
) -> tuple[float, Plan]:
    """Gain and plan of a greedy choice: add the test with the largest gain per bench time until they are enough.

    Args:
        seconds: bench time of each test.
        table: Gram matrices of each test.
        names: of the signals that are logged.
        known: information (n, n) of the present data on the second model, and on the first.
    """
    total = [np.zeros((len(own) + 1, len(own) + 1)) for own in known]
    gain, chosen = 0.0, dict[int, int]()
    while gain < settings.enough:
        options = []
        for k, time in enumerate(seconds):
            full = len(chosen) == settings.most and k not in chosen
            if not table[k] or full or chosen.get(k, 0) == settings.repeats:
                continue
            added = [whole + sum(table[k][name][side] for name in names) for side, whole in enumerate(total)]
            worth = min(remaining(one, own) for one, own in zip(added, known, strict=True))
            options.append(((min(worth, settings.enough) - gain) / time, k, worth, added))
        _, k, worth, added = max(options, key=lambda option: option[:2], default=(0.0, 0, gain, total))
        if worth <= gain:
            break
        total, gain = added, worth
        chosen[k] = chosen.get(k, 0) + 1
    return gain, sorted(chosen.items())


def _described(session: Session, fits: Sequence[FinalFit], tests: Tests, signals: Signals, gain: float) -> NextTest:
    """The answer: tests to run, signals to log, and the same as the text of a test plan."""
    one, other = (" + ".join(fit.names) or "none" for fit in fits)
    have = {signal.name for signal in session.dataset.signals}
    return NextTest(
        separates=(one, other),
        gain=gain,
        tests=tuple(test.planned for test in tests),
        log=tuple(signal.name for signal in signals),
        assumed={s.name: (s.noise, s.unit) for s in signals if s.name not in have and s.noise is not None},
        plan=plan_text(tests, signals, session.dataset.system, (one, other)),
    )
