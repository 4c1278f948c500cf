"""Small models in Modelica text, with closed forms, for what needs a compiled FMU with derivatives of outputs."""

from pathlib import Path

from fmu_build import build
from pysim.io import read_model
from pysim.types import Model

LAG = """model Lag "T y' + y = K u"
  parameter Real T(unit="s", min=1e-3) = 0.5;
  parameter Real K = 2;
  parameter Real y_start = 0.3;
  input Real u(start=0);
  output Real y(start=y_start, fixed=true);
  output Real power;
equation
  T*der(y) + y = K*u;
  power = K*u*y;
end Lag;
"""

TANK = """model Tank "Two volumes joined by a linear resistance: their sum is nobody's to hold"
  parameter Real C = 2;
  parameter Real R = 0.5;
  input Real q(start=0);
  output Real p1(start=1, fixed=true);
  output Real p2(start=1, fixed=true);
equation
  C*der(p1) = q - (p1 - p2)/R;
  C*der(p2) = (p1 - p2)/R;
end Tank;
"""

RELAY = """model Relay "A first-order lag behind a switch"
  parameter Real T(unit="s") = 0.5;
  input Real u(start=0);
  output Real x(start=0, fixed=true);
equation
  T*der(x) + x = if u > 0 then 1 else -1;
end Relay;
"""

PEAKS = """model Peaks "x = sin t, and how often it rose above 0.9995, where it stays for 63 ms"
  output Real x(start=0, fixed=true);
  output Real v(start=1, fixed=true);
  output Integer n(start=0, fixed=true);
equation
  der(x) = v;
  der(v) = -x;
  when x > 0.9995 then
    n = pre(n) + 1;
  end when;
end Peaks;
"""

MIXED = """model Mixed "A number of each type in and out"
  input Real r(start=0.5);
  input Integer i(start=2);
  input Boolean b(start=false);
  output Real twice = 2*r;
  output Integer next = i + 1;
  output Boolean opposite = not b;
end Mixed;
"""

LATE = """model Late "Feeds back what it was a while ago"
  input Real u(start=0);
  output Real x(start=0, fixed=true);
equation
  der(x) = u - delay(x, 0.2);
end Late;
"""

DISCARDS = """model Discards "Fails where the input falls below -1"
  input Real u(start=0);
  output Real x(start=0, fixed=true);
equation
  der(x) = sqrt(1 + u) - x;
end Discards;
"""


ROOT = """model Root "An output that cannot be differentiated where its state begins"
  parameter Real a = 1;
  output Real x(start=0, fixed=true);
  output Real y;
equation
  der(x) = a;
  y = sqrt(x);
end Root;
"""


def text_model(text: str, folder: Path, *, fmi: int = 2) -> Model:
    """The model of that text, compiled anew unless the folder holds it."""
    name = text.split()[1]
    output = folder / f"{name}_{fmi}.fmu"
    if not output.exists():
        library = folder / f"{name}.mo"
        library.write_text(text, encoding="utf-8")
        build(name, output, libraries=[library], fmi=fmi)
    return read_model(output)
