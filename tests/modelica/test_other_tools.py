"""What other tools take from the library: equations they need not differentiate, and FMUs that pass the check."""

import re
from functools import cache

import casadi as ca
import pytest

from fmu_build import build
from fmu_build.build import bundled_library
from fmu_build.front import load
from fmu_build.lower import OdeModel, lower
from fmu_build.lower.index_reduction import _Pantelides
from pysim.fmu_check.checks import CHECKS
from pysim.fmu_check.result import FAILS
from pysim.fmu_check.subject import Subject, read_subject
from pysim.fmu_check.worker import results_of
from tests.modelica.library import LIBRARY, models_in

PACKAGES = ("Examples", "Validation", "Pump", "LoadCircuit", "Crane", "Controllers")
INSIDE_OTHERS = {  # parts that need values or something at their connectors
    *(
        "Pump.A4VSG",
        "Pump.A4VSGCoupled",
        "Pump.PistonPull",
        "Pump.BlackBoxPlate",
        "Pump.ControlPiston",
        "Pump.ControllerCard",
        "Pump.GreyBoxPlate",
    ),
    *("Pump.MeanFlow", "Pump.PadeDeadTime", "Pump.PistonKinematicsFlow", "Pump.SecondOrderSpool"),
    *("Pump.SimplifiedRippleFlow", "Pump.SwashPlateLinkage", "Pump.TransportDelay", "LoadCircuit.PulseCounter"),
    *("Crane.Payload", "Crane.VesselDrum"),
}
RUNNABLE = [
    name
    for package in PACKAGES
    for name in models_in(package)
    if name.removeprefix("HydraulicTestBench.") not in INSIDE_OTHERS
]
WITH_A_WIRE = (
    *(pytest.param(f"Crane.{name}", marks=pytest.mark.slow) for name in ("IdealCompensation", "HydraulicCompensation")),
    *("Validation.WireDrop", "Validation.PayloadFall"),
)

QUIET = [check for check in CHECKS if not check.startswith("call order")]
BASE = "HydraulicTestBench"


@cache
def subject(name: str) -> Subject:
    return read_subject(build(name))


def lowered(name: str) -> OdeModel:
    return lower(load(name, [bundled_library()], {}), ())


@pytest.fixture
def differentiated(monkeypatch: pytest.MonkeyPatch) -> list[ca.SX]:
    """Residuals of the equations that index reduction differentiates."""
    found: list[ca.SX] = []
    original = _Pantelides._differentiate

    def noted(self: _Pantelides, met: set[int]) -> dict[int, int]:
        found.extend(self.equations[k].residual for k in met)
        return original(self, met)

    monkeypatch.setattr(_Pantelides, "_differentiate", noted)
    return found


@pytest.mark.parametrize("name", WITH_A_WIRE)
def test_a_wire_needs_no_index_reduction(name: str, differentiated: list[ca.SX]) -> None:
    """Two variables that a connection makes equal are one variable; no other equation is differentiated."""
    lowered(f"{BASE}.{name}")
    laws = [str(residual) for residual in differentiated if not _is_equality(residual)]
    assert laws == []


def _is_equality(residual: ca.SX) -> bool:
    """Whether it says a = b."""
    symbols = ca.symvar(residual)
    slopes = ca.jacobian(residual, ca.vertcat(*symbols))
    return len(symbols) == 2 and slopes.is_constant() and sorted(slopes.nonzeros()) == [-1.0, 1.0]


def test_the_crane_in_a_swell_shows_its_payloads() -> None:
    variables = lowered(f"{BASE}.Examples.ActiveHeave").variables
    outputs = {v.name: v.unit for v in variables if v.causality == "output"}
    assert outputs == {"z_v": "m", "z_active": "m", "z_passive": "m"}


def test_a_pump_flow_knows_its_number_of_pistons() -> None:
    """An array over the pistons has a size before any value is given from outside."""
    text = (LIBRARY / "Interfaces" / "PartialPumpFlow.mo").read_text(encoding="utf-8")
    assert re.search(r"parameter Integer N_p = 9 ", text)


def test_the_fluid_adapter_has_a_medium_that_is_whole() -> None:
    text = (LIBRARY.parent / "HydraulicTestBenchMSL" / "Adapters" / "FluidAdapter.mo").read_text(encoding="utf-8")
    default, least = re.findall(r"(?:package Medium =|constrainedby) (Modelica\.Media\.[\w.]+)", text)[:2]
    assert "Partial" not in default
    assert least == "Modelica.Media.Interfaces.PartialMedium"


def test_the_percent_sign_has_its_reason() -> None:
    """Unit 1 with display unit % would show 5000 % for the command 50, which users type and logs hold."""
    percent, rate = (
        (LIBRARY / "Types" / f"{name}.mo").read_text(encoding="utf-8") for name in ("Percent", "PercentRate")
    )
    assert ('unit="%"' in percent, 'unit="%/s"' in rate) == (True, True)
    assert "shows 5000 %" in " ".join(percent.split())


@pytest.mark.slow
@pytest.mark.parametrize("name", RUNNABLE)
@pytest.mark.parametrize("check", QUIET)
def test_its_fmu_passes_the_check(name: str, check: str) -> None:
    failed = [str(result) for result in results_of(check, subject(name)) if result.verdict == FAILS]
    assert failed == []


@pytest.mark.parametrize("name", ["LoadCircuit.SampledTestBench", "Pump.CommandRateObserver", "Controllers.PI"])
def test_start_values_and_steps_of_sampled_and_fast_parts_pass_the_check(name: str) -> None:
    """A clock that ticks at the start changes a discrete variable after initialisation, which is no fault."""
    found = [result for check in ("start values", "runs") for result in results_of(check, subject(f"{BASE}.{name}"))]
    assert len(found) == 5
    assert [str(result) for result in found if result.verdict == FAILS] == []
