import pytest

import fmu_build
from pysim.io import read_model
from pysim.types import Model

LAG = """model Lag "First-order lag with a gain, and a second gain that only the product tells"
  parameter Real K(min=0.1, max=10) = 1.5;
  parameter Real T(min=0.01, max=5, unit="s") = 0.4;
  parameter Real g(min=0.1, max=10) = 1;
  parameter Real fragile(min=-1, max=1) = 0;
  input Real w;
  output Real y;
  Real x(start=0, fixed=true);
equation
  T*der(x) = K*g*w - x + log(1 - fragile);
  y = x;
end Lag;
"""


@pytest.fixture(scope="session")
def lag(tmp_path_factory: pytest.TempPathFactory) -> Model:
    """T dx/dt = K g w - x, from rest."""
    folder = tmp_path_factory.mktemp("lag")
    (folder / "Lag.mo").write_text(LAG)
    return read_model(fmu_build.build("Lag", folder / "Lag.fmu", libraries=[folder / "Lag.mo"]))
