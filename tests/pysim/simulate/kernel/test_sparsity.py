import dataclasses

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from pysim.simulate import Rodas, simulate
from pysim.simulate.kernel.sparsity import column_groups, dependency_pattern
from pysim.types import Abilities, Experiment
from tests.pysim.simulate.fixture_fmus import STIFF


def abilities(pattern: np.ndarray) -> Abilities:
    states = tuple(f"x{i}" for i in range(len(pattern)))
    depends = tuple(frozenset(s for s, on in zip(states, row, strict=True) if on) for row in pattern)
    return Abilities(2, True, False, True, False, 0, states, states, dependencies=depends)


@given(st.integers(1, 9).flatmap(lambda n: st.lists(st.booleans(), min_size=n * n, max_size=n * n)))
def test_no_derivative_depends_on_two_states_of_a_group(flags):
    n = round(len(flags) ** 0.5)
    pattern = np.array(flags).reshape(n, n)
    groups = column_groups(pattern)
    assert sorted(state for group in groups for state in group) == list(range(n))
    for group in groups:
        assert pattern[:, group].sum(axis=1).max() <= 1


def test_chain_needs_three_groups_whatever_its_length():
    band = np.abs(np.subtract.outer(np.arange(50), np.arange(50))) <= 1
    assert len(column_groups(band)) == 3


def test_unknown_dependencies_are_all_dependencies():
    unknown = dataclasses.replace(abilities(np.eye(3)), dependencies=(None, frozenset(), frozenset({"x1"})))
    np.testing.assert_array_equal(dependency_pattern(unknown), [[1, 1, 1], [0, 0, 0], [0, 1, 0]])
    assert dependency_pattern(dataclasses.replace(unknown, dependencies=())).all()


def test_grouped_columns_give_the_same_run(fixture_model):
    model = fixture_model(STIFF)  # its two states have nothing to do with each other
    grouped = dataclasses.replace(
        model,
        abilities=dataclasses.replace(model.abilities, dependencies=(frozenset({"x"}), frozenset({"y"}))),
    )
    assert [len(column_groups(dependency_pattern(m.abilities))) for m in (model, grouped)] == [2, 1]
    experiment = Experiment(np.array([1.0, 5.0]), ("x", "y"))
    one, other = (simulate(m, experiment, solver=Rodas()) for m in (model, grouped))
    np.testing.assert_array_equal(one.values, other.values)
    assert one.statistics == other.statistics
