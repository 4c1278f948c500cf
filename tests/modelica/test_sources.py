"""Sources at the pump."""

from pathlib import Path

import numpy as np
import pytest

from pysim.simulate import simulate
from pysim.types import Experiment, Signal
from tests.modelica.built import FINE, built, ran

PUMP = """model Held
  HydraulicTestBench.Sources.Constant command(k=30);
  HydraulicTestBench.Sources.Constant rate;
  HydraulicTestBench.Pump.FreeGreyBox pump;
equation
  connect(command.y, pump.alphaCMD);
  connect(rate.y, pump.alphaCMD_t);
end Held;
"""


def test_constant_command_and_rate_are_the_input_left_alone(tmp_path: Path) -> None:
    """An FMU's input that nothing drives is 0; inside a model something has to say so."""
    text = tmp_path / "Held.mo"
    text.write_text(PUMP)
    held = ran(built("Held", (), (text,)), 1.0, ("pump.alphaPercent", "pump.alphaCMD_t"))
    run = Experiment(held.time, ("alphaPercent",), {"alphaCMD": Signal.constant(30.0)})
    alone = simulate(built("Pump.FreeGreyBox"), run, solver=FINE)
    assert not np.any(held["pump.alphaCMD_t"])
    assert np.allclose(held["pump.alphaPercent"], alone["alphaPercent"], rtol=1e-5, atol=1e-6)
    assert held["pump.alphaPercent"][-1] == pytest.approx(30, abs=0.5)  # springs and leakage keep it off by some
