import dataclasses
import math
import re
import subprocess
import sys

import numpy as np
import pytest

from pysim.simulate import Rk45, Rodas, simulate
from pysim.simulate._library import open_library
from pysim.simulate._run import run
from pysim.types import BadInput, Experiment, Outcome, Signal
from tests.pysim.simulate.fixture_fmus import FOLLOWER, OSCILLATOR
from tests.pysim.simulate.text_models import MIXED, text_model

_NONE = Signal.constant(0.0)
_TIMES = np.array([0.0, 1.0])


def test_record_says_what_it_is(fixture_model):
    record = simulate(fixture_model(OSCILLATOR), Experiment(_TIMES, ("x", "u", "power", "time")))
    assert record.names == ("x", "u", "power", "time")
    assert record.units == ("m", "N", "W", "1")
    assert record.origin == "simulated oscillator"
    assert record.message == ""
    assert set(record.statistics) == {"steps", "rejected", "derivatives", "jacobians", "events"}


@pytest.mark.parametrize("fmi", [2, 3])
def test_overrides_and_start_values_take_effect(fixture_model, fmi):
    end = Experiment(np.array([math.pi]), ("x", "w"), overrides={"x": 0.7, "w": 0.5, "D": 0.0})
    record = simulate(fixture_model(OSCILLATOR, fmi), end)
    np.testing.assert_allclose(record.values, [[0.7 * math.cos(0.5 * math.pi), 0.5]], atol=1e-6)


@pytest.mark.parametrize("fmi", [2, 3])
def test_numbers_of_every_type_are_set_and_recorded(tmp_path, fmi):
    model = text_model(MIXED, tmp_path, fmi=fmi)
    given = {"b": 1.0, "r": 1.25, "i": 41.0}
    record = simulate(model, Experiment(_TIMES, ("next", "twice", "opposite", "i", "b"), overrides=given))
    np.testing.assert_array_equal(record.values, [[42.0, 2.5, 0.0, 41.0, 1.0]] * 2)
    np.testing.assert_array_equal(simulate(model, Experiment(_TIMES, ("next", "opposite"))).values, [[3.0, 1.0]] * 2)


def test_undriven_input_is_constant_and_can_be_overridden(fixture_model):
    record = simulate(fixture_model(FOLLOWER), Experiment(_TIMES, ("x",), overrides={"u": 3.0}))
    np.testing.assert_allclose(record["x"], [0, 3], rtol=1e-13)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"record": ("xx",)}, "no variable 'xx'; near it: x"),
        ({"inputs": {"v": _NONE}}, "v is no input but local; inputs: u, u_rate"),
        ({"inputs": {"force": _NONE}}, "no variable 'force'"),
        ({"overrides": {"mass": 1.0}}, "no variable 'mass'"),
        ({"overrides": {"power": 1.0}}, "power (output) cannot be set"),
        ({"overrides": {"der(x)": 1.0}}, "der(x) (local) cannot be set"),
        ({"overrides": {"w": math.nan}}, "w cannot be set to nan"),
        ({"overrides": {"u": 1.0}, "inputs": {"u": _NONE}}, "u has a signal and an override"),
        ({"inputs": {"u": _NONE}, "rates": {"x": "u"}}, "x is no input"),
    ],
)
def test_misuse_is_said_in_one_sentence(fixture_model, change, words):
    experiment = dataclasses.replace(Experiment(_TIMES, ("x",)), **change)
    with pytest.raises(BadInput, match=re.escape(words)):
        simulate(fixture_model(OSCILLATOR), experiment)


def test_a_file_name_is_no_model_and_a_class_no_solver(fixture_model):
    experiment = Experiment(_TIMES, ("x",))
    with pytest.raises(BadInput, match=r"model is 'pump\.fmu'; give what pysim\.io\.read_model makes"):
        simulate("pump.fmu", experiment)
    with pytest.raises(BadInput, match="give a solver with its settings"):
        simulate(fixture_model(OSCILLATOR), experiment, solver=Rodas)
    with pytest.raises(BadInput, match="got None; give Experiment"):
        simulate(fixture_model(OSCILLATOR), None)


def test_a_run_that_was_stopped_says_so(fixture_model):
    looks = iter([False, True])
    long = Experiment(np.append(_TIMES, 1e9), ("x",), overrides={"D": 0.0, "x": 1.0})
    with open_library(fixture_model(OSCILLATOR)) as library:
        record = run(library, long, Rk45(), lambda: next(looks))
    assert record.outcome is Outcome.STOPPED
    assert record.message.startswith("the run was asked to stop at ")
    assert 0 < len(record.time) < 3


def test_simulating_and_comparing_need_no_compiler_no_front_end_and_no_large_part_of_scipy() -> None:
    """Every command pays for what these import."""
    large = "{'rumoca', 'casadi', 'ziglang', 'matplotlib', 'scipy.optimize', 'scipy.signal', 'scipy.stats'}"
    code = f"import sys, pysim.identify, pysim.simulate; print(*({large} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == ""
