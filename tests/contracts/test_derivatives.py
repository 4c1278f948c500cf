"""Directional derivatives, adjoint derivatives and dependencies of every model, at a point off its start."""

from collections.abc import Iterator

import numpy as np
import pytest

from tests.cases import CASES, Case
from tests.contracts.fmu import Fmu

SAME = 1e-14  # relative: an unknown that is solved for anew may differ in its last digit
PROBE = 1e-6  # step of finite differences, relative to a variable's size: 1 Pa where orifices are smooth over 1e3 Pa


def scales(fmu: Fmu, names: list[str], values: np.ndarray) -> np.ndarray:
    """Size of each variable: its value or its nominal value, whichever is larger."""
    nominal = [float(fmu.variables[name].nominal or 1.0) for name in names]
    return np.maximum(np.abs(values), nominal)


class Point:
    """A model-exchange instance in continuous time whose states and inputs are a little off their start values."""

    def __init__(self, fmu: Fmu, case: Case) -> None:
        self.fmu = fmu
        self.instance = fmu.open("me").start(case.settings)
        random = np.random.default_rng(2)
        self.states = fmu.states
        self.inputs = fmu.of(causality="input", variability="continuous")
        self.knowns = [*self.states, *self.inputs]
        values = np.concatenate([self.instance.x, self.instance.get(self.inputs)])
        self.scale = scales(fmu, self.knowns, values)
        self.move(values + 1e-3 * self.scale * random.uniform(0.5, 1, values.size))

    def move(self, values: np.ndarray) -> None:
        self.values = values
        if self.states:
            self.instance.x = values[: len(self.states)]
        self.instance.set(dict(zip(self.inputs, values[len(self.states) :], strict=True)))

    def finite_difference(self, unknowns: list[str], k: int) -> np.ndarray:
        """Change of the unknowns with the k-th known."""
        base, step = self.values, PROBE * self.scale[k]
        results = []
        for sign in (1, -1):
            moved = base.copy()
            moved[k] += sign * step
            self.move(moved)
            results.append(self.instance.get(unknowns))
        self.move(base)
        return (results[0] - results[1]) / (2 * step)


@pytest.fixture
def point(fmu: Fmu, case: Case) -> Iterator[Point]:
    made = Point(fmu, case)
    yield made
    made.instance.raw.freeInstance()


def unknowns_of(fmu: Fmu) -> list[str]:
    return [*fmu.derivatives, *fmu.of(causality="output", variability="continuous")]


def test_directional_derivatives_are_those_of_finite_differences(point: Point, fmu: Fmu) -> None:
    unknowns = unknowns_of(fmu)
    values = point.instance.get(unknowns)
    exact = np.array([point.instance.directional(unknowns, [known], [1.0]) for known in point.knowns]).T
    numeric = np.array([point.finite_difference(unknowns, k) for k in range(len(point.knowns))]).T
    if not exact.size:
        return
    weight = np.abs(exact * point.scale).max(axis=1) + 1e-4 * np.abs(values)
    # truncation is (1e-3)^2 at the orifices, rounding of the order 1e-16/PROBE; both stay well below 1e-5
    assert (np.abs((exact - numeric) * point.scale) <= 1e-5 * weight[:, None] + 1e-12).all()


# An event at the start writes the history of delay() anew, so a difference shows more than the held values.
@pytest.mark.parametrize("case", [case for case in CASES if not case.has_delay], ids=lambda case: case.name)
def test_derivatives_by_tunable_parameters(point: Point, fmu: Fmu, case: Case) -> None:
    parameters = fmu.of(causality="parameter", variability="tunable")
    unknowns = unknowns_of(fmu)
    values = point.instance.get(unknowns)
    for name, value in zip(parameters, point.instance.get(parameters), strict=True):
        size = abs(value) or 1.0
        results = []
        for sign in (1, -1):
            point.instance.set_in_event_mode({name: value + sign * PROBE * size})
            point.move(point.values)
            results.append(point.instance.get(unknowns))
        point.instance.set_in_event_mode({name: value})
        point.move(point.values)
        numeric = (results[0] - results[1]) / 2 / PROBE
        exact = point.instance.directional(unknowns, [name], [size])
        limit = 1e-8 * (1 + np.abs(values).max(initial=0))
        np.testing.assert_allclose(exact, numeric, rtol=1e-5, atol=limit, err_msg=name)


def test_seeds_add_up(point: Point, fmu: Fmu) -> None:
    unknowns = unknowns_of(fmu)
    random = np.random.default_rng(3)
    seed = random.normal(size=len(point.knowns)) * point.scale
    single = [point.instance.directional(unknowns, [known], [s]) for known, s in zip(point.knowns, seed, strict=True)]
    together = point.instance.directional(unknowns, point.knowns, seed)
    total = np.sum(single, axis=0) if single else np.zeros(len(unknowns))
    np.testing.assert_allclose(together, total, rtol=1e-9, atol=1e-12 * np.abs(single).max(initial=1))


def test_seeds_of_parameters_add_up_at_every_point(point: Point, fmu: Fmu) -> None:
    """Those of dx alone take another way than those with an output among them."""
    parameters = fmu.of(causality="parameter", variability="tunable")
    unknowns = unknowns_of(fmu)
    seed = np.random.default_rng(5).normal(size=len(parameters)) * (np.abs(point.instance.get(parameters)) + 1e-3)
    for shift in (0.0, 1e-3):
        point.move(point.values + shift * point.scale)
        whole = point.instance.directional(unknowns, parameters, seed)
        alone = point.instance.directional(fmu.derivatives, parameters, seed)
        single = [point.instance.directional(fmu.derivatives, [p], [s]) for p, s in zip(parameters, seed, strict=True)]
        size = 1e-12 * np.abs(single).max(initial=1, axis=0)
        np.testing.assert_array_less(np.abs(np.sum(single, axis=0) - alone), size)
        np.testing.assert_array_less(np.abs(whole[: len(fmu.derivatives)] - alone), size)


@pytest.mark.parametrize("fmi", [3], indirect=True)
def test_adjoint_derivatives_are_the_transpose(point: Point, fmu: Fmu) -> None:
    unknowns = unknowns_of(fmu)
    forward = np.array([point.instance.directional(unknowns, [known], [1.0]) for known in point.knowns])
    reverse = np.array([point.instance.adjoint([unknown], point.knowns, [1.0]) for unknown in unknowns]).T
    size = np.abs(forward).max(initial=0)
    np.testing.assert_allclose(reverse.reshape(forward.shape), forward, rtol=1e-9, atol=1e-13 * size)


def test_what_is_no_dependency_has_no_influence(point: Point, fmu: Fmu) -> None:
    listed = [*fmu.description.derivatives, *fmu.description.eventIndicators, *fmu.description.outputs]
    listed = [u for u in listed if u.variable.variability == "continuous"]
    names = [u.variable.name for u in listed]
    before = point.instance.get(names)
    for k, known in enumerate(point.knowns):
        moved = point.values.copy()
        moved[k] += 1e-3 * point.scale[k]
        base, after = point.values, None
        point.move(moved)
        after = point.instance.get(names)
        point.move(base)
        for unknown, a, b in zip(listed, before, after, strict=True):
            if known not in [d.name for d in unknown.dependencies]:
                assert a == pytest.approx(b, rel=SAME, abs=0.0), f"{unknown.variable.name} depends on {known}"


def test_time_is_a_dependency_where_it_matters(point: Point, fmu: Fmu) -> None:
    listed = [*fmu.description.derivatives, *fmu.description.outputs]
    listed = [u for u in listed if u.variable.variability == "continuous"]
    names = [u.variable.name for u in listed]
    before = point.instance.get(names)
    point.instance.raw.setTime(1e-3)
    for unknown, a, b in zip(listed, before, point.instance.get(names), strict=True):
        if "time" not in [d.name for d in unknown.dependencies]:
            assert a == pytest.approx(b, rel=SAME, abs=0.0), unknown.variable.name


def test_constant_factors_stay(point: Point, fmu: Fmu) -> None:
    """Kinds that promise linearity: the derivative is the same at another point."""
    linear = {"constant", "fixed", "tunable", "discrete"}
    pairs = [
        (unknown.variable.name, known.name)
        for unknown in [*fmu.description.derivatives, *fmu.description.outputs]
        for known, kind in zip(unknown.dependencies, unknown.dependenciesKind, strict=True)
        if kind in linear and known.name in point.knowns
    ]
    first = [point.instance.directional([unknown], [known], [1.0])[0] for unknown, known in pairs]
    point.move(point.values + 1e-3 * point.scale)
    second = [point.instance.directional([unknown], [known], [1.0])[0] for unknown, known in pairs]
    assert first == second


def test_initial_unknowns_depend_on_what_they_say(fmu: Fmu, case: Case) -> None:
    listed = fmu.description.initialUnknowns
    names = [u.variable.name for u in listed]
    knowns = [
        v.name
        for v in fmu.description.modelVariables
        if v.type in ("Real", "Float64") and (v.causality == "input" or v.initial == "exact")
        if v.variability != "constant"
    ]
    with fmu.open("me") as instance:
        instance.begin(case.settings)
        before = instance.get(names)
        for known, value in zip(knowns, instance.get(knowns), strict=True):
            instance.set({known: value * (1 + 1e-3) or 1e-3})
            after = instance.get(names)
            instance.set({known: value})
            for unknown, a, b in zip(listed, before, after, strict=True):
                if known not in [d.name for d in unknown.dependencies]:
                    assert a == b, f"{unknown.variable.name} depends on {known}"
        np.testing.assert_allclose(instance.get(names), before, rtol=1e-9)
