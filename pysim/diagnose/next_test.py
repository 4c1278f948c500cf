"""The experiment that would tell two explanations apart."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.candidate_tests import CandidateTest, candidate_tests
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.loggable import loggable
from pysim.diagnose.noise import estimated_noise
from pysim.diagnose.residuals import Ruler
from pysim.diagnose.separation import Evidence, Table, cheapest, evidence
from pysim.diagnose.subject import Subject
from pysim.identify.greybox.observation import Run
from pysim.identify.greybox.time_log import TimeLog
from pysim.simulate import Rodas, simulate
from pysim.types import BadInput, Dataset, Experiment, MeasuredSignal, NextTest, Outcome, Record

Array = NDArray[np.float64]

# Expected difference of the sums of squares that settles a tie with room to spare: five times what names a winner.
ENOUGH = 50.0


def next_test(subject: Subject, one: Fitted, other: Fitted, *, workers: int | None = None) -> NextTest | None:
    """The shortest set of tests that is expected to separate two fitted models, or None where none would.

    Each model in turn is taken for the truth, and the other is refitted, to first order, to the data at hand and to
    the new test together; the smaller of the two misfits that remain is the gain. Signals that are logged already are
    preferred; one more is asked for where they are not enough, an output of the model rather than a state.

    Args:
        one, other: with slopes that are exact at their points.
        workers: runs at a time; all cores where None.
    Raises:
        BadInput: measurements without a log over time, with other than one command or one that never moves, or without
            an output whose noise is told or seen.
    Source: Atkinson and Fedorov 1975, Biometrika 62:57 (T-optimality), with the information of the data at hand.
    """
    dataset = subject.dataset
    if dataset is None:
        return None
    at_hand = _logged(subject, dataset)
    tests = candidate_tests(dataset, partial(_settled, subject, one, at_hand), subject.model)
    more = loggable(subject, dataset, (one, other), tests, workers)
    signals = (*at_hand, *more.outputs, *more.states)
    table = _table(subject, one, other, tests, signals, workers)
    known = (_information(other), _information(one))
    logged = tuple(s.name for s in at_hand)
    best: tuple[float, list[tuple[int, int]], tuple[str, ...]] = (0.0, [], ())
    tiers = [logged], *([(*logged, signal.name) for signal in new] for new in (more.outputs, more.states))
    for tier in tiers:
        for names in tier:
            gain, chosen = cheapest([t.seconds for t in tests], table, names, known, ENOUGH)
            if gain > best[0] * (1 if best[0] < ENOUGH else 4):
                best = (gain, chosen, names)
        if best[0] >= ENOUGH:
            break
    gain, chosen, names = best
    if gain < ENOUGH:
        return None
    plan = [test for k, count in chosen for test in tests[k].longer(count)]
    rivals = (_name(one), _name(other))
    asked = [signal for signal in signals if signal.name in names]
    return NextTest(rivals, gain, _about(plan, asked, logged), _plan_text(dataset, plan, asked, rivals))


def _logged(subject: Subject, dataset: Dataset) -> tuple[MeasuredSignal, ...]:
    """Outputs with their noise: as the data set tells it, else as the residuals of their logs are counted."""
    outputs = [signal for signal in dataset.signals if signal.role == "output"]
    untold = any(signal.noise is None for signal in outputs)
    seen = estimated_noise(subject.targets, told=False) if untold else {}
    found = []
    for signal in outputs:
        noise = seen.get((dataset.name, signal.name)) if signal.noise is None else None
        if noise is not None:  # what is seen has the rounding in it
            signal = replace(signal, noise=math.sqrt(max(noise.deviation**2 - _noise(signal) ** 2, 0.0)))
        if _noise(signal) > 0:
            found.append(signal)
    return tuple(found)


def _settled(subject: Subject, fitted: Fitted, signals: Sequence[MeasuredSignal], run: Experiment) -> float:
    """When all signals stay within their noise of where they end, s; the end where they do not, or cannot be run."""
    if not signals:
        raise BadInput("a next test needs an output whose noise is known; tell it in the data set, or log the output")
    overrides = {**subject.targets[0].runs[0].experiment.overrides, **fitted.what.space.values(fitted.point.x)}
    asked = replace(run, record=tuple(s.variable for s in signals), overrides=overrides)
    record = simulate(fitted.what.model, asked, solver=Rodas(rtol=1e-5, atol=1e-5), check=False)
    if record.outcome is not Outcome.DONE or not np.isfinite(record.values).all():
        return float(run.times[-1])
    away = np.abs(record.values - record.values[-1]) > [_noise(s) for s in signals]
    last = np.flatnonzero(away.any(axis=1))
    return float(record.time[last[-1]]) if last.size else 0.0


def _name(fitted: Fitted) -> str:
    return " + ".join(effect.name for effect in fitted.what.effects) or "none"


def _information(fitted: Fitted) -> Array:
    return np.asarray(fitted.point.jacobian.T @ fitted.point.jacobian)


def _noise(signal: MeasuredSignal) -> float:
    return float(np.hypot(signal.noise or 0.0, (signal.resolution or 0.0) / np.sqrt(12)))


def _ruler(
    subject: Subject, fitted: Fitted, tests: Sequence[CandidateTest], signals: Sequence[MeasuredSignal],
    workers: int | None,
) -> Ruler:  # fmt: skip
    """Counts the tests as though all their readings were zero."""
    overrides = dict(subject.targets[0].runs[0].experiment.overrides)
    variables = tuple(signal.variable for signal in signals)
    targets = []
    for number, test in enumerate(tests):
        experiment = test.experiment(fitted.what.model, variables, overrides)
        nothing = np.zeros((experiment.times.size, len(signals)))
        reading = Record(experiment.times, nothing, tuple(s.name for s in signals), tuple(s.unit for s in signals))
        noise = tuple(_noise(signal) for signal in signals)
        run = Run(str(number), experiment)
        targets.append(TimeLog("next test", str(number), "other", "fit", reading, noise, noise, run, index=number))
    return Ruler(tuple(targets), workers=workers)


def _table(
    subject: Subject, one: Fitted, other: Fitted, tests: Sequence[CandidateTest], signals: Sequence[MeasuredSignal],
    workers: int | None,
) -> Table:  # fmt: skip
    """Test by test what each signal says; a test that cannot be simulated says nothing."""
    table: list[dict[str, tuple[Evidence, Evidence]]] = []
    ends = np.cumsum([0, *(test.samples * len(signals) for test in tests)]).tolist()
    points = [_ruler(subject, f, tests, signals, workers).evaluation(f.what, f.point.x) for f in (one, other)]
    if not all(point.good for point in points):
        return [{} for _ in tests]
    first, second = points
    for begin, end in itertools.pairwise(ends):
        own = {}
        for j, signal in enumerate(signals):
            rows = slice(begin + j, end, len(signals))
            apart = first.residual[rows] - second.residual[rows]
            own[signal.name] = (evidence(apart, second.jacobian[rows]), evidence(apart, first.jacobian[rows]))
        table.append(own)
    return table


def _about(plan: Sequence[CandidateTest], asked: Sequence[MeasuredSignal], logged: Sequence[str]) -> str:
    new = [f"{s.name}, {s.noise:.2g}{'' if s.unit == '1' else ' ' + s.unit}" for s in asked if s.name not in logged]
    also = f" (new: {new[0]} of noise assumed)" if new else ""
    return f"Run {'; '.join(str(test) for test in plan)}. Log {', '.join(s.name for s in asked)}{also}."


def _plan_text(
    dataset: Dataset, plan: Sequence[CandidateTest], asked: Sequence[MeasuredSignal], rivals: tuple[str, str]
) -> str:
    """A test plan for `pysim bench` or a real one."""
    rows = [f"# Separates {rivals[0]} from {rivals[1]}.", "", "[plan]", 'name = "next-test"']
    rows += [f'description = "to tell {rivals[0]} from {rivals[1]}"', f'system = "{dataset.system}"', ""]
    for signal in (plan[0].input, *asked):
        rows += [f'[signals."{signal.name}"]', f'role = "{signal.role}"', f'unit = "{signal.unit}"']
        rows += [f'quantity = "{signal.quantity}"', f'variable = "{signal.variable}"']
        rows += [f"{key} = {value:.6g}" for key in ("noise", "resolution") if (value := getattr(signal, key))] + [""]
    rows += ["[logging]", f"rate = {1 / plan[0].interval:.6g}", ""]
    for number, test in enumerate(plan, 1):
        rows += [*test.plan_rows(tuple(signal.name for signal in asked), f"test-{number}"), ""]
    return "\n".join(rows)
