"""The files that the scripts of docs/tutorials read: logs of plants that have what their models lack, and noise."""

from collections.abc import Mapping
from datetime import UTC, datetime, timedelta
from functools import cache
from pathlib import Path
from tempfile import mkdtemp

import numpy as np

from fmu_build import build
from pysim.effects import read_catalogue, variant
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, Record, Signal
from tests.foreign import made_foreign

AXIS = """
package MyLib
  partial model PartialForce "What acts on the carriage besides its own guideway"
    input Real x(unit="m");
    input Real v(unit="m/s");
    output Real f(unit="N");
  end PartialForce;
  model NoForce extends PartialForce; equation f = 0; end NoForce;
  model Friction "Dry friction"
    extends PartialForce;
    parameter Real F_c(unit="N", min=0, max=1000, nominal=100) = 0 "0 = off";
  equation
    f = -F_c*tanh(v/1e-3);
    annotation(__HydraulicTestBench(effect="axis.friction", slot="guideway"));
  end Friction;
  model Incline "Weight along an axis that is not level"
    extends PartialForce;
    parameter Real F_g(unit="N", min=-400, max=400, nominal=50) = 0 "0 = off";
  equation
    f = -F_g;
    annotation(__HydraulicTestBench(effect="axis.incline", slot="guideway"));
  end Incline;
  model Hardening "Spring that grows stiffer"
    extends PartialForce;
    parameter Real c_3(unit="N/m3", min=0, max=1e12, nominal=1e11) = 0 "0 = off";
  equation
    f = -c_3*x^3;
    annotation(__HydraulicTestBench(effect="axis.hardening", slot="guideway"));
  end Hardening;
  model Axis "A carriage against a hydraulic spring"
    parameter Real m(unit="kg", min=10, max=100, nominal=40) = 40;
    parameter Real d(unit="N.s/m", min=0, max=1e4, nominal=2e3) = 2e3;
    parameter Real c(unit="N/m", min=1e6, max=5e7, nominal=5e6) = 5e6;
    parameter Real A(unit="m2") = 2e-3;
    input Real F(unit="N", start=0);
    output Real x(unit="m", start=0, fixed=true);
    output Real p_A(unit="Pa") "Pressure of the spring";
    Real v(unit="m/s", start=0, fixed=true);
    replaceable NoForce guideway constrainedby PartialForce;
  equation
    guideway.x = x;
    guideway.v = v;
    der(x) = v;
    m*der(v) = F - d*v - c*x + guideway.f;
    p_A = (c*x + d*v)/A;
  end Axis;
end MyLib;
"""
DRAG = """model Drag
  extends MyLib.PartialForce;
  parameter Real F_0(unit="N", min=0, max=1000, nominal=100) = 0 "0 = off";
  parameter Real c_2(unit="N.s2/m2", min=0, max=1e6, nominal=1e4) = 0 "0 = off";
equation
  f = -F_0*tanh(v/1e-3) - c_2*v*abs(v);
  annotation(__HydraulicTestBench(effect="plant.drag", slot="guideway"));
end Drag;
"""
RIG = """
model Mass
  parameter Real m(unit="kg") = 1;
  Real x(unit="m", start=0, fixed=true);
  Real v(unit="m/s", start=0, fixed=true);
  Real f(unit="N");
equation
  der(x) = v;
  m*der(v) = f;
end Mass;
model Spring
  parameter Real c(unit="N/m") = 30;
  parameter Real d(unit="N.s/m") = 0.8;
end Spring;
model Rig
  parameter Real K(unit="N/V") = 0.1;
  constant Real F_c(unit="N") = FRICTION;
  input Real u(unit="V", start=0);
  output Real x(unit="m");
  Mass mass;
  Spring spring;
equation
  x = mass.x;
  mass.f = K*u - spring.c*mass.x - spring.d*mass.v - F_c*tanh(mass.v/1e-3);
end Rig;
"""
TRUE = {"m": 38.0, "d": 1700.0, "c": 4e6}  # of the axis
FRICTION = 150.0  # N, dry, of the axis in script 2
STRENGTHS = {"F_0": 120.0, "c_2": 4e4}  # N and N.s2/m2, of the axis in script 5
RIG_TRUE = {"mass.m": 1.1, "spring.c": 27.0}
RIG_FRICTION = 0.02  # N
_NOISE = {"x": 2e-5, "p_A": 3e4}  # m, Pa
_EARLY = 3  # samples of 1 ms that the pressure is read early
_BEGAN = datetime(2026, 3, 1, 14, 5, tzinfo=UTC)


def write_library(folder: Path) -> Path:
    """MyLib, with no more effects in it than a user's."""
    library = folder / "MyLib" / "package.mo"
    library.parent.mkdir()
    library.write_text(AXIS.strip().removesuffix("end MyLib;") + "end MyLib;\n")
    return library.parent


@cache
def _axis(effect: str) -> tuple[Path, str]:
    """The FMU of the axis with an effect, and the name ahead of the effect's parameters."""
    folder = Path(mkdtemp(prefix="axis-"))
    own = folder / "Drag.mo"
    own.write_text(DRAG)
    libraries = [write_library(folder), own]
    (found,) = [one for library in libraries for one in read_catalogue(library) if one.name == effect]
    made = variant("MyLib.Axis", [found], libraries, name="Plant")
    source = folder / "Plant.mo"
    source.write_text(made.text)
    return build("Plant", libraries=[*libraries, source]), made.places[effect]


def _run(seed: int, seconds: float, effect: str, strengths: Mapping[str, float]) -> Record:
    """The axis under a force that changes every 20 ms, read each ms."""
    fmu, place = _axis(effect)
    rng = np.random.default_rng(seed)
    knots = np.arange(0.0, seconds + 0.1, 0.02)
    push = 3e3 * rng.standard_normal(knots.size)
    push[:2] = 0.0
    force, times = Signal.through(knots, push), np.arange(round(1e3 * seconds)) / 1e3
    other = {**TRUE, **{f"{place}.{name}": value for name, value in strengths.items()}}
    clean = simulate(
        read_model(fmu), Experiment(times, ("x", "p_A"), {"F": force}, other), solver=Rodas(rtol=1e-7, atol=1e-9)
    )
    read = [clean[name] + sd * rng.standard_normal(times.size) for name, sd in _NOISE.items()]
    return Record(times, np.column_stack([force.value(times), *read]), ("F", "x", "p_A"), ("N", "m", "Pa"))


def with_faults(folder: Path) -> None:
    """Script 2: dates for a time, a turned sign, a pressure that is read early, and empty cells."""
    write_library(folder)
    (folder / "logs").mkdir()
    for k in range(3):
        log = _run(20 + k, 2.5, "axis.friction", {"F_c": FRICTION})
        lines = ["timestamp,F [N],x,p_A"]
        for j in range(log.time.size - _EARLY):
            cells = [log["F"][j], -1e3 * log["x"][j], 1e-5 * log["p_A"][j + _EARLY]]
            texts = [f"{cell:.6g}" for cell in cells]
            texts[1] = "" if k == 0 and 1200 <= j < 1206 else texts[1]
            lines.append(",".join([f"{_BEGAN + timedelta(milliseconds=j):%Y-%m-%d %H:%M:%S.%f}", *texts]))
        (folder / "logs" / f"run{k + 1}.csv").write_text("\n".join(lines))


def with_drag(folder: Path) -> None:
    """Script 5: a drag that no library has."""
    write_library(folder)
    (folder / "logs").mkdir()
    for k in range(3):
        log = _run(50 + k, 2.0, "plant.drag", STRENGTHS)
        rows = zip(log.time[::2], log["F"][::2], 1e3 * log["x"][::2], strict=True)
        lines = ["t [s],F [N],x [mm]", *(f"{t:.4f},{force:.6g},{x:.6g}" for t, force, x in rows)]
        (folder / "logs" / f"run{k + 1}.csv").write_text("\n".join(lines))


def of_another_tool(folder: Path) -> None:
    """Script 3: a closed FMU, and one log whose index are date-times."""
    import pandas

    built = {}
    for name, friction in (("Rig", 0.0), ("Friction", RIG_FRICTION)):
        source = Path(mkdtemp(prefix="rig-")) / "Rig.mo"
        source.write_text(RIG.replace("FRICTION", repr(friction)))
        built[name] = build("Rig", libraries=[source])
    made_foreign(built["Rig"], folder / "theirs.fmu", "Rig_of_another_tool")
    rng = np.random.default_rng(3)
    times = np.arange(2000) / 100
    volts = Signal.through(np.arange(0, 20.5, 0.4), np.r_[0.0, 0.0, 2 * rng.standard_normal(50)])
    run = Experiment(times, ("x",), {"u": volts}, RIG_TRUE)
    x = 1e3 * simulate(read_model(built["Friction"]), run, solver=Rodas(rtol=1e-7, atol=1e-9))["x"]
    index = pandas.DatetimeIndex([_BEGAN + timedelta(milliseconds=10 * k) for k in range(times.size)])
    read = x + 0.05 * rng.standard_normal(times.size)
    pandas.DataFrame({"u [V]": volts.value(times), "x [mm]": read}, index=index).to_parquet(folder / "rig.parquet")


def pump(folder: Path) -> None:
    """Script 4: the FMU that is controlled."""
    from pysim.workflow import model_of

    (folder / "pump.fmu").write_bytes(model_of("HydraulicTestBench.Pump.FreeGreyBox").path.read_bytes())
