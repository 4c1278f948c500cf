"""Derivatives column by column, in groups, or as whole matrices: the same numbers."""

import dataclasses
import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from unittest.mock import PropertyMock, patch

import numpy as np
import pytest

from pysim.simulate import Esdirk, Sensitivities, sensitivities
from pysim.simulate._library import Instance, open_library
from pysim.types import Experiment, Model, Signal
from tests.pysim.simulate.text_models import LAG, text_model

CASCADE = """model Cascade "Three lags in a row; each output sees one state and two parameters at most"
  parameter Real T1 = 0.5;
  parameter Real T2 = 0.3;
  parameter Real K = 2;
  parameter Real G = 3;
  input Real u(start=0);
  output Real x1(start=0, fixed=true);
  output Real x2(start=0, fixed=true);
  output Real scaled;
  output Real square;
equation
  T1*der(x1) + x1 = K*u;
  T2*der(x2) + x2 = x1;
  scaled = G*x2;
  square = x1^2;
end Cascade;
"""
_TIGHT = Esdirk(1e-9, 1e-9)
_NAMES = ("T1", "T2", "K", "G")


@contextmanager
def as_of_others() -> Iterator[None]:
    """FMUs of ours are asked as one of others would be."""
    with patch.object(Instance, "_own_functions", new_callable=PropertyMock, return_value=False):
        yield


def cascade(model: Model) -> Sensitivities:
    record = ("x1", "x2", "scaled", "square")
    signal = Signal(np.zeros(1), np.zeros((1, 4)), np.array([[[1.0, 0.5 * math.pi, 2.0, 0.0]]]))
    return sensitivities(model, Experiment(np.linspace(0, 2, 9), record, {"u": signal}), _NAMES, solver=_TIGHT)


@pytest.mark.parametrize("fmi", [2, 3])
def test_whole_matrices_are_the_columns(tmp_path: Path, fmi: int) -> None:
    model = text_model(CASCADE, tmp_path, fmi=fmi)
    with open_library(model) as library, library.instance() as instance:
        column_of = instance.column_of()
        assert column_of is not None
        columns = [column_of(model[name].reference) for name in ("T1", "T2", "K", "G", "x1", "u")]
    assert sorted(columns[:4]) == [0, 1, 2, 3]
    assert columns[4:] == [-1, -1]
    ours = cascade(model)
    with as_of_others():
        others = cascade(model)
    assert ours.exact
    assert others.exact
    np.testing.assert_array_equal(ours.by_parameter, others.by_parameter)


def test_asking_by_the_declared_dependencies_leaves_nothing_out(tmp_path: Path) -> None:
    model = text_model(CASCADE, tmp_path)
    known = dict(model.abilities.output_dependencies)
    assert (known["scaled"], known["square"]) == ({"x2"}, {"x1"})
    silent = {"output_dependencies": (), "initial_dependencies": (), "dependencies": ()}
    unknown = dataclasses.replace(model, abilities=dataclasses.replace(model.abilities, **silent))
    with as_of_others():
        declared, all_of_it = cascade(model), cascade(unknown)
    np.testing.assert_allclose(declared.by_parameter, all_of_it.by_parameter, rtol=1e-9, atol=1e-12)


def test_closed_form_of_a_lag(tmp_path: Path) -> None:
    """T y' + y = K from y(0) = 0.3: y = K + (0.3 - K) exp(-t / T)."""
    times, lag, gain = np.linspace(0, 2, 11), 0.5, 2.0
    model = text_model(LAG, tmp_path)
    experiment = Experiment(times, ("y", "power"), overrides={"u": 1.0})
    fall = np.exp(-times / lag)
    y, by_lag, by_gain = gain + (0.3 - gain) * fall, (0.3 - gain) * fall * times / lag**2, 1 - fall
    found = sensitivities(model, experiment, ("T", "K"), solver=_TIGHT)
    np.testing.assert_allclose(found.record.values, np.stack([y, gain * y], axis=1), rtol=1e-8)
    np.testing.assert_allclose(found.by_parameter[:, 0], np.stack([by_lag, by_gain], axis=1), atol=1e-7)
    np.testing.assert_allclose(
        found.by_parameter[:, 1], np.stack([gain * by_lag, y + gain * by_gain], axis=1), atol=1e-7
    )
