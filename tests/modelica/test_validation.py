"""The Validation models against the closed forms they carry, and the examples against known behaviour."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from pysim.thesis import read_csv
from tests.modelica.library import Run, assert_balanced, compiled, run

REFERENCE = Path(__file__).parents[2] / "validation" / "reference" / "pump_time_response.csv"


CLOSED_FORMS: list[tuple[str, float, float, dict[str, float]]] = [  # name, stop, errors from this time on, their bounds
    ("ChamberFilling", 1.0, 0.0, {"error": 14e5 * 1e-9}),  # floor of the volume: a share of 1e-10
    ("OrificesInSeries", 0.2, 0.1, {"error": 34e5 * 1e-6}),  # steady state; smoothing 1e-8
    ("SpoolStep", 0.1, 0.0, {"error": 1e-6}),
    ("PistonOscillation", 2.0, 0.0, {"error": 5e-3 * 1e-5}),
    ("EndStop", 0.1, 0.05, {"error": 1e-3}),  # N, of 6823 N, at rest
    ("DeadTimeSine", 0.2, 0.1, {"error": 3e-6}),  # (omega tau)^7 / 100800 = 1.1e-6, solver beside it
    ("LinkageRates", 1.0, 0.0, {"error": 1e-6, "error_t": 1e-4}),
    ("CommandRate", 0.2, 0.1, {"error": 125.7 * 3e-4}),  # (omega T)^3 = 2.5e-4
    ("CommandRate", 0.2, 0.0, {"error_told": 1e-3}),  # of 126 %/s; what the solver leaves, times 3/T
    ("CoastDown", 3.0, 0.0, {"error": 50 * 1e-6}),
    # relative volume, of 0.02 pumped in
    ("VolumeFilling", 2.0, 0.0, {"error": 1e-10, "error_rising": 1e-10, "error_airy": 1e-9}),
    ("LaminarFilling", 5.0, 0.0, {"error": 100e5 * 1e-8, "error_Q": 1e-5 * 1e-8}),
    # smoothing of 1 Pa at 105 bar: 1e-15
    ("ServoValveLoad", 0.03, 0.0, {"error": 1e-8, "error_Q": 1.5e-3 * 1e-10}),
    ("TwoMassTwist", 0.2, 0.0, {"error": 0.01 * 1e-6, "momentum": 1e-9}),
    # the beginning of the pull: k_w e_soft^2 / e of 5 kN and more, for 0.4 s; drum of 1e6 kg m2
    ("WireDrop", 0.45, 0.0, {"error": 2e-5}),
]


@cache
def validated(name: str, stop: float) -> Run:
    model = compiled(f"HydraulicTestBench.Validation.{name}")
    assert_balanced(model)
    return run(model, stop, tolerance=1e-10)


@pytest.mark.parametrize(("name", "stop", "after", "bounds"), CLOSED_FORMS)
def test_error_stays_within_its_reason(name: str, stop: float, after: float, bounds: dict[str, float]) -> None:
    result = validated(name, stop)
    for error, bound in bounds.items():
        assert np.abs(result[error][result.time >= after]).max() < bound, error


def test_untold_rate_is_off_by_no_less_than_its_theory() -> None:
    """The estimate's error is (omega T)^3 = 2.5e-4 of the rate: a tolerance that hides a better law is wrong too."""
    result = validated("CommandRate", 0.2)
    error = np.abs(result["error"][result.time >= 0.1]).max()
    assert error == pytest.approx(2 * np.pi * 20 * (2 * np.pi * 20 * 0.5e-3) ** 3, rel=0.05)


def test_end_stop_gives_way_by_hundredths_of_a_millimetre() -> None:
    """h k d = A p with h = d^2 / (d^2 + d_soft^2), solved for d."""
    force, stiffness, soft = 401.33e-6 * 170e5, 1e9, 5e-6
    depth = np.roots([stiffness, -force, 0, -force * soft**2])
    expected = float(depth[np.isreal(depth)].real[0])
    assert validated("EndStop", 0.1)["depth"][-1] == pytest.approx(expected, rel=1e-4)
    assert expected < 2e-5


def test_locked_pump_survives_its_full_stroke() -> None:
    """The volume of a chamber falls below zero by geometry, and everything stays finite."""
    result = run(compiled("HydraulicTestBench.Examples.FullStroke"), 1.2, tolerance=1e-6)
    for name in ("xp", "xp_t", "p1", "p2", "u", "alphaPercent"):
        assert np.isfinite(result[f"pump.{name}"]).all(), name
    assert result["pump.chamber2.V"].min() < 0
    assert result["pump.xp"].max() > 17.1e-3 * 0.99
    assert np.abs(result["pump.xp"]).max() < 17.1e-3 + 0.3e-3  # 500 kg at full speed against 1e9 N/m


@pytest.mark.parametrize("example", ["TimeResponse", "UntoldRate"])
def test_time_response_is_that_of_an_independent_simulation(example: str) -> None:
    """Root-mean-square differences far below 0.02 percent, 0.001 and 0.5 bar."""
    rows = read_csv(REFERENCE)
    time = [float(row["time_s"]) for row in rows]
    result = run(compiled(f"HydraulicTestBench.Examples.{example}"), 5.0, points=2501)
    columns = {"alphaPercent": ("alpha_percent", 2e-3), "u": ("u", 1e-4), "p1": ("p1_Pa", 5e3), "p2": ("p2_Pa", 5e3)}
    for name, (column, limit) in columns.items():
        difference = np.interp(time, result.time, result[f"pump.{name}"]) - [float(row[column]) for row in rows]
        assert np.sqrt(np.mean(difference**2)) < limit, name
