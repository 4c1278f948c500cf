"""The experiment that would tell two explanations apart."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.candidate_tests import CandidateTest, candidate_tests
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.residuals import Ruler
from pysim.diagnose.separation import Evidence, Table, cheapest, evidence
from pysim.diagnose.subject import Subject
from pysim.identify.greybox.log_target import LogTarget
from pysim.identify.greybox.target import Run
from pysim.simulate import Rodas, simulate
from pysim.types import Dataset, Experiment, MeasuredSignal, NextTest, Record

Array = NDArray[np.float64]

# Expected difference of the sums of squares that settles a tie with room to spare: five times what names a winner.
ENOUGH = 50.0
# Noise taken for a signal that was never logged, in shares of what it goes through.
_UNLOGGED = 1e-3


def next_test(subject: Subject, one: Fitted, other: Fitted, *, workers: int | None = None) -> NextTest | None:
    """The shortest set of tests that is expected to separate two fitted models, or None where none would.

    Each model in turn is taken for the truth, and the other is refitted, to first order, to the data at hand and to
    the new test together; the smaller of the two misfits that remain is the gain. Signals that are logged already are
    preferred; one more output or state of the model is asked for where they are not enough.

    Args:
        one, other: with slopes that are exact at their points.
        workers: runs at a time; all cores where None.
    Raises:
        BadInput: measurements without a log over time, or with other than one command.
    Source: Atkinson and Fedorov 1975, Biometrika 62:57 (T-optimality), with the information of the data at hand.
    """
    dataset = subject.dataset
    if dataset is None:
        return None
    tests = candidate_tests(dataset, partial(_settled, subject, one), subject.model)
    signals = _signals(subject, dataset, one, tests, workers)
    table = _table(subject, one, other, tests, signals, workers)
    known = (_information(other), _information(one))
    logged = tuple(s.name for s in dataset.signals if s.role == "output" and s in signals)
    extra = tuple(s.name for s in signals if s.name not in logged)
    best: tuple[float, list[tuple[int, int]], tuple[str, ...]] = (0.0, [], ())
    for names in (logged, *((*logged, name) for name in extra)):
        gain, chosen = cheapest([t.seconds for t in tests], table, names, known, ENOUGH)
        if gain > best[0] * (1 if best[0] < ENOUGH else 4):
            best = (gain, chosen, names)
        if names == logged and gain >= ENOUGH:
            break
    gain, chosen, names = best
    if gain < ENOUGH:
        return None
    plan = [test for k, count in chosen for test in tests[k].longer(count)]
    rivals = (_name(one), _name(other))
    return NextTest(rivals, gain, _about(plan, names, logged), _plan_text(dataset, plan, names, signals, rivals))


def _settled(subject: Subject, fitted: Fitted, run: Experiment) -> float:
    """When all logged signals stay within their noise of where they end, s; the end where they do not."""
    assert subject.dataset is not None
    signals = [s for s in subject.dataset.signals if s.role == "output" and _noise(s) > 0]
    overrides = {**subject.targets[0].runs[0].experiment.overrides, **fitted.what.space.values(fitted.point.x)}
    asked = replace(run, record=tuple(s.variable for s in signals), overrides=overrides)
    record = simulate(fitted.what.model, asked, solver=Rodas(rtol=1e-5, atol=1e-5))
    away = np.abs(record.values - record.values[-1]) > [_noise(s) for s in signals]
    last = np.flatnonzero(away.any(axis=1))
    return float(record.time[last[-1]]) if last.size else 0.0


def _name(fitted: Fitted) -> str:
    return " + ".join(effect.name for effect in fitted.what.effects) or "none"


def _information(fitted: Fitted) -> Array:
    return np.asarray(fitted.point.jacobian.T @ fitted.point.jacobian)


def _signals(
    subject: Subject, dataset: Dataset, one: Fitted, tests: Sequence[CandidateTest], workers: int | None
) -> tuple[MeasuredSignal, ...]:
    """What may be logged: signals of the data set, then outputs and states of the model with noise assumed."""
    logged = [s for s in dataset.signals if s.role == "output" and _noise(s) > 0]
    known = {s.variable for s in dataset.signals}
    names = [v.name for v in subject.model.variables if v.causality == "output"] + list(subject.model.abilities.states)
    new = [name for name in dict.fromkeys(names) if name not in known and name in _names(subject) & _named(one)]
    if not new:
        return tuple(logged)
    unit = [MeasuredSignal(name, "output", subject.model[name].unit, name, name, noise=1.0) for name in new]
    ruler = _ruler(subject, one, tests, unit, workers)
    values = ruler.at(one.what, one.point.x)
    if values is None:
        return tuple(logged)
    spans = np.ptp(values.reshape(-1, len(new)), axis=0)
    return (*logged, *(replace(s, noise=_UNLOGGED * span) for s, span in zip(unit, spans, strict=True) if span > 0))


def _names(subject: Subject) -> set[str]:
    return {v.name for v in subject.model.variables}


def _named(fitted: Fitted) -> set[str]:
    return {v.name for v in fitted.what.model.variables}


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
        targets.append(LogTarget("next test", str(number), "other", "fit", reading, noise, noise, run))
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


def _about(plan: Sequence[CandidateTest], names: Sequence[str], logged: Sequence[str]) -> str:
    new = [name for name in names if name not in logged]
    also = f" (new: {', '.join(new)}, noise of a thousandth of its span assumed)" if new else ""
    return f"Run {'; '.join(str(test) for test in plan)}. Log {', '.join(names)}{also}."


def _plan_text(
    dataset: Dataset, plan: Sequence[CandidateTest], names: Sequence[str], signals: Sequence[MeasuredSignal],
    rivals: tuple[str, str],
) -> str:  # fmt: skip
    """A test plan for `pysim bench` or a real one."""
    rows = [f"# Separates {rivals[0]} from {rivals[1]}.", "", "[plan]", 'name = "next-test"']
    rows += [f'description = "to tell {rivals[0]} from {rivals[1]}"', f'system = "{dataset.system}"', ""]
    by_name = {signal.name: signal for signal in signals}
    for signal in (plan[0].input, *(by_name[name] for name in names)):
        rows += [f'[signals."{signal.name}"]', f'role = "{signal.role}"', f'unit = "{signal.unit}"']
        rows += [f'quantity = "{signal.quantity}"', f'variable = "{signal.variable}"']
        rows += [f"{key} = {value:.6g}" for key in ("noise", "resolution") if (value := getattr(signal, key))] + [""]
    rows += ["[logging]", f"rate = {1 / plan[0].interval:.6g}", ""]
    for number, test in enumerate(plan, 1):
        rows += [*test.plan_rows(tuple(names), f"test-{number}"), ""]
    return "\n".join(rows)
