"""The bench under its sampled controllers: its steady states by hand, and the continuous bench as its limit."""

import numpy as np
import pytest

from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, Record, Signal
from tests.modelica.built import built

K = 60e-6 / (2 * np.pi)  # m3/rad
REFERENCES = {"omegaS_ref": Signal.lines([0, 1], [0, 30.0]), "pL_ref": Signal.lines([0, 2, 3], [0, 0, 40e5])}


def bench(name: str, times: np.ndarray, recorded: tuple[str, ...], **overrides: float) -> Record:
    run = Experiment(times, recorded, REFERENCES, overrides)
    return simulate(built(f"LoadCircuit.{name}"), run, solver=Rodas(rtol=1e-7, atol=1e-7))


def test_speed_and_load_pressure_come_to_rest_without_error() -> None:
    names = ("rig.omega", "rig.pL", "rig.pSupply", "rig.T_s", "rig.T_L", "rig.shaftFriction.tau")
    end = dict(zip(names, bench("SampledTestBench", np.array([40.0]), names).values[-1], strict=True))
    assert end["rig.omega"] == pytest.approx(30.0, rel=1e-4)
    assert end["rig.pL"] == pytest.approx(40e5, rel=1e-5)
    assert end["rig.pSupply"] == 310e5
    assert end["rig.T_L"] == pytest.approx(K * 40e5, rel=1e-5)
    friction = 14.8939 + (54.8258 - 14.8939) * np.exp(-30 / 8.3593)
    assert end["rig.shaftFriction.tau"] == pytest.approx(friction, rel=1e-3)
    assert end["rig.T_s"] - end["rig.T_L"] == pytest.approx(friction, rel=1e-3)


def test_it_comes_to_the_continuous_bench_as_samples_get_dense() -> None:
    """Sampling lags by half a period: a tenth of the period, a tenth of the difference."""
    times = np.linspace(0.0, 4.0, 401)
    smooth = bench("TestBench", times, ("rig.omega", "rig.pL"))
    off = []
    for dt in (2e-3, 2e-4):
        sampled = bench("SampledTestBench", times, ("rig.omega", "rig.pL"), dt=dt)
        off.append(np.sqrt(np.mean((sampled.values - smooth.values) ** 2, axis=0)))
    assert (off[1] < 0.12 * off[0]).all()
    assert off[0][0] < 0.1
    assert off[0][1] < 0.5e5
