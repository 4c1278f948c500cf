"""The machines of the case: logs that start at rest, and a truth that leaves nothing but noise."""

import numpy as np
import pytest

from pysim.diagnose.residuals import rulers
from pysim.diagnose.subject import extended
from pysim.types import Record
from validation.rig_diagnosis.friction_figure import friction_torque
from validation.rig_diagnosis.machines import KNOWN_BADLY, MACHINES, asked, catalogue, measured, truth
from validation.rig_diagnosis.tests_of_bench import ALONG


def test_every_machine_has_an_effect_of_the_bench_or_none() -> None:
    assert set(MACHINES) - {"none"} <= set(catalogue())
    assert len(catalogue()) == 6
    for machine, values in MACHINES.items():
        if machine != "none":
            assert set(values) == {p.name for p in catalogue()[machine].parameters}
            for name, value in values.items():
                assert catalogue()[machine][name].min < value < catalogue()[machine][name].max


def test_the_truth_leaves_noise_and_the_model_does_not() -> None:
    data = measured("shaft.friction", seed=5)
    for log in data.dataset.logs():
        assert isinstance(log.data, Record)
        assert log.data.names == ("alphaCMD", "u_ref", "omega", "pS", "pL")
        assert log.data["alphaCMD"][0] == log.data["u_ref"][0] == 0.0
        np.testing.assert_allclose(log.data["u_ref"], ALONG * log.data["alphaCMD"], rtol=1e-12)
    given = asked(data)
    assert set(given.free) == set(KNOWN_BADLY)
    fitted, held = rulers(given.targets)
    what = extended(given, [catalogue()["shaft.friction"]])
    values = truth("shaft.friction")
    x = what.space.to_search(np.array([values[name] for name in what.space.keys]))
    for ruler in (fitted, held):
        assert ruler is not None
        residual = ruler.at(what, x)
        assert residual is not None
        assert residual @ residual / residual.size == pytest.approx(1.0, abs=0.05)
    bare = extended(given, [])
    left = fitted.at(bare, bare.space.to_search(np.array([values[name] for name in bare.space.keys])))
    assert left is not None
    assert left @ left / left.size > 100


def test_friction_over_speed_is_the_thesis_law() -> None:
    speed = np.array([-30.0, 0.0, 0.1, 8.3593])
    linear = friction_torque({"c": 0.22}, speed)
    np.testing.assert_allclose(linear, 0.22 * speed)
    full = friction_torque(truth("shaft.friction"), speed) - linear
    assert full[1] == 0.0
    assert full[2] == pytest.approx(np.tanh(1.38806) * (14.8939 + 39.9319 * np.exp(-0.1 / 8.3593)))
    assert full[3] == pytest.approx(14.8939 + 39.9319 / np.e)
    assert full[0] == pytest.approx(-(14.8939 + 39.9319 * np.exp(-30 / 8.3593)))
