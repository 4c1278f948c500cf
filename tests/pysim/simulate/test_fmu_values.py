from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
import pytest

from pysim.simulate import FmuValues, is_number
from pysim.simulate._library import Instance, open_library
from pysim.types import BadInput, Model, Variable
from tests.pysim.simulate.text_models import MIXED, text_model

INPUTS, OUTPUTS = ("i", "r", "b"), ("opposite", "twice", "next")


@contextmanager
def initialising(model: Model) -> Iterator[Instance]:
    with open_library(model) as library, library.instance() as instance:
        instance.enter_initialisation({}, 0.0, 1.0, None)
        yield instance


def values(instance: Instance, names: tuple[str, ...], array: np.ndarray) -> FmuValues:
    model = instance.model
    return FmuValues(model.abilities.fmi, [model[name] for name in names], array, instance.address)


@pytest.fixture(scope="module", params=[2, 3])
def mixed(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Model:
    return text_model(MIXED, tmp_path_factory.mktemp("mixed"), fmi=request.param)


def test_numbers_of_every_type_go_in_and_out_in_the_order_asked_for(mixed: Model) -> None:
    given, found = np.array([41.0, 1.25, 1.0]), np.zeros(3)
    with initialising(mixed) as instance:
        ins, outs = values(instance, INPUTS, given), values(instance, OUTPUTS, found)
        assert not ins.is_plain
        component = instance.component
        assert ins.write(component) == 0
        assert outs.read(component) == 0
        assert found.tolist() == [0.0, 2.5, 42.0]
        given[:] = [-3.0, 0.0, 0.0]
        assert ins.write(component) == 0
        assert outs.read(component) == 0
        assert found.tolist() == [1.0, 0.0, -2.0]


def test_reals_alone_need_no_memory_in_between(mixed: Model) -> None:
    given, found = np.array([3.0]), np.zeros(1)
    with initialising(mixed) as instance:
        ins, outs = values(instance, ("r",), given), values(instance, ("twice",), found)
        assert ins.is_plain
        assert ins.write(instance.component) == 0
        assert outs.read(instance.component) == 0
    assert found[0] == 6.0


def test_no_variables_are_no_call(mixed: Model) -> None:
    with initialising(mixed) as instance:
        assert values(instance, (), np.zeros(0)).write(instance.component) == 0


def test_an_array_or_a_text_is_no_number() -> None:
    assert is_number(3, "UInt16")
    assert not is_number(2, "UInt16")
    vector = Variable("p", 1, "Float64[3]", "input", "continuous", None, "1", None, "", None, None, None, None)
    with pytest.raises(BadInput, match="p is Float64"):
        FmuValues(3, [vector], np.zeros(1), lambda name: 0)
