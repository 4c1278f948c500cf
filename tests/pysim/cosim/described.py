"""A mass and a spring as two FMUs, and a lag under a controller, as TOML files describe them."""

from pathlib import Path

from tests.pysim.simulate.text_models import LAG, text_model

MASS = """model Mass "A mass that a force moves"
  parameter Real m(unit="kg") = 2;
  input Real F(unit="N", start=0);
  output Real v(unit="m/s", start=0, fixed=true);
equation
  m*der(v) = F;
end Mass;
"""

SPRING = """model Spring "A spring, stretched at the start"
  parameter Real k(unit="N/m") = 50;
  parameter Real x_start(unit="m") = 0.1;
  input Real v(unit="m/s", start=0);
  output Real F(unit="N");
  Real x(unit="m", start=x_start, fixed=true);
equation
  der(x) = v;
  F = -k*x;
end Spring;
"""

OSCILLATOR = """[system]
name = "Mass and spring"

[members.mass]
fmu = "Mass_2.fmu"
parameters = { m = 4.0 }

[members.spring]
fmu = "Spring_2.fmu"
record = ["x"]

[[connections]]
from = "spring.F"
to = "mass.F"

[[connections]]
from = "mass.v"
to = "spring.v"

[overrides]
spring.k = 100.0

[run]
stop = 1.0
step = 1e-3
rows_every = 0.01
order = "gauss-seidel"
"""

CONTROLLED = """[members.plant]
fmu = "Lag_2.fmu"
interface = "model-exchange"

[members.controller]
block = "pysim.control.PI"
settings = { K_p = 1.0, T_i = 0.5, dt = 0.01 }
every = 0.01

[[connections]]
from = "plant.y"
to = "controller.measured"

[[connections]]
from = "controller.u"
to = "plant.u"

[inputs]
controller.reference = "reference.csv"

[run]
stop = 10.0
step = 0.01
record = ["plant.y", "controller.u"]
"""


def oscillator(folder: Path) -> Path:
    """The file, beside its FMUs."""
    for text in (MASS, SPRING):
        text_model(text, folder)
    (folder / "oscillator.toml").write_text(OSCILLATOR, encoding="utf-8")
    return folder / "oscillator.toml"


def controlled(folder: Path) -> Path:
    """The file, beside its FMU and its reference."""
    text_model(LAG, folder)
    (folder / "reference.csv").write_text("time,value\n0,0\n1,0\n1.01,3\n20,3\n", encoding="utf-8")
    (folder / "controlled.toml").write_text(CONTROLLED, encoding="utf-8")
    return folder / "controlled.toml"
