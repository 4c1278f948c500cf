"""A cylinder: its position may begin anywhere, and it moves on at a command at which others come to rest."""

import math

import numpy as np
import pytest

import fmu_build
from pysim.identify.greybox import Parameter, Treatment, fit, fit_at, problem
from pysim.identify.greybox.context import Context
from pysim.io import read_model
from pysim.types import Dataset, MeasuredRecord, MeasuredSignal, Model, Record
from tests.pysim.identify.greybox import measurements as m

CYLINDER = """model Cylinder "Cylinder that turns a lever, driven by a valve with a lag"
  parameter Real K(unit="m/s", min=0, max=10, nominal=0.5) = 0.4;
  parameter Real T(unit="s", min=1e-3, max=2, nominal=0.1) = 0.1;
  constant Real pn(unit="Pa") = 1e6;
  constant Real length(unit="m") = 1;
  input Real u(unit="1");
  output Real angle(unit="rad") "Of the lever; there is none beyond 1 m";
  Real x(unit="m", start=0.2, fixed=true);
  Real p(unit="Pa", start=0, fixed=true, nominal=1e6) "Pressure that drives it";
equation
  der(x) = K*p/pn;
  T*der(p) = pn*u - p;
  angle = asin(x/length);
end Cylinder;
"""
K, T, NOISE = 0.5, 0.15, 1e-4
PN = 1e6  # Pa
TIME = np.arange(0, 4, 0.01)


@pytest.fixture(scope="module")
def cylinder(tmp_path_factory: pytest.TempPathFactory) -> Model:
    folder = tmp_path_factory.mktemp("cylinder")
    (folder / "Cylinder.mo").write_text(CYLINDER)
    return read_model(fmu_build.build("Cylinder", folder / "Cylinder.fmu", libraries=[folder / "Cylinder.mo"]))


def moving(x: float, p: float, use: str, seed: int) -> MeasuredRecord:
    """From a position (m) and a pressure (Pa), in closed form; the command is 1 for half the log and then -1."""
    half, noise = TIME.size // 2, NOISE * np.random.default_rng(seed).standard_normal(TIME.size)
    clean, command = np.empty(TIME.size), np.where(np.arange(TIME.size) < half, 1.0, -1.0)
    for part, u in ((slice(None, half + 1), 1.0), (slice(half, None), -1.0)):
        t = TIME[part] - TIME[part][0]
        fading = np.exp(-t / T)
        clean[part] = x + K * u * t + K * (p / PN - u) * T * (1 - fading)
        x, p = clean[part][-1], PN * (u + (p / PN - u) * fading[-1])
    record = Record(TIME, np.column_stack([command, np.arcsin(clean) + noise]), ("u", "angle"), ("1", "rad"))
    return MeasuredRecord(f"{use}-{seed}.txt", "other", use, record)


@pytest.fixture(scope="module")
def data() -> Dataset:
    signals = (
        MeasuredSignal("u", "input", "1", "command", "u", hold="previous"),
        MeasuredSignal("angle", "output", "rad", "angle of the lever", "angle", noise=NOISE),
    )
    records = (moving(-0.3, 6e5, "fit", 1), moving(-0.6, -4e5, "fit", 2), moving(-0.4, 2e5, "validate", 3))
    return Dataset("cylinder", "", "cylinder", signals, records)


def test_a_position_behind_an_integrator_is_told_from_a_lag(cylinder: Model, lag: Model, data: Dataset) -> None:
    assert Context(cylinder, data, {}, ("angle",), {"angle": NOISE}, Treatment(), ()).integrates
    short = m.dataset([m.log(TIME, np.ones(TIME.size), np.ones(TIME.size))])
    assert not Context(lag, short, {}, ("y",), {"y": 1.0}, Treatment(), ()).integrates


def test_logs_of_a_cylinder_that_moves_are_fitted_and_compared(cylinder: Model, data: Dataset) -> None:
    """A run that waited at the first command for rest once drove the cylinder out of reach."""
    task = problem(cylinder, [data], (Parameter("K"), Parameter("T")))
    found = fit(task)
    for estimate, truth in zip(found.estimates, (K, T), strict=True):
        low, high = estimate.interval
        assert low - (high - low) < truth < high + (high - low)
    again = fit_at(task, {e.name: e.value for e in found.estimates})
    for one in (*found.records, *again.records):
        assert one.simulated.time[0] == pytest.approx(0.0)
        assert np.std(one.residual.values) == pytest.approx(1.0, rel=0.1)  # of the noise


def test_where_a_cylinder_began_has_an_interval(cylinder: Model, data: Dataset) -> None:
    """A pascal moves the lever by a millionth of what a metre does; that once counted as nothing."""
    found = fit(problem(cylinder, [data], (Parameter("K"), Parameter("T"))))
    begun = {one.name: one for one in found.initial}
    for log, x, p in (("fit-1.txt", -0.3, 6e5), ("fit-2.txt", -0.6, -4e5), ("validate-3.txt", -0.4, 2e5)):
        for name, truth in (("x", x), ("p", p)):
            low, high = begun[f"{name}@{log}"].interval
            assert math.isfinite(low)
            assert low - (high - low) < truth < high + (high - low)
