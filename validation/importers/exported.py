"""The FMUs that are tried: what they are driven with, and the reference results stored beside this file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import fmu_build
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.thesis import read_csv
from pysim.types import Experiment, Signal

Array = NDArray[np.float64]
FOLDER = Path(__file__).parent / "reference"


@dataclass(frozen=True)
class Exported:
    """A class of the library as an FMU, under constant inputs from the start on."""

    name: str
    model: str  # behind HydraulicTestBench.
    outputs: tuple[str, ...]
    inputs: Mapping[str, float]
    events: bool = False  # whether the run goes past events, of time or state
    at_rest: bool = False  # whether all states stand still until the first event
    stop: float = 1.0  # s
    step: float = 0.01  # s, of communication and of the stored results

    @property
    def times(self) -> Array:
        """Every communication point after the start (n_t,), s."""
        return np.arange(1, round(self.stop / self.step) + 1, dtype=np.float64) * self.step

    def build(self, fmi: int) -> Path:
        """The .fmu of this version of FMI, from the cache."""
        return Path(fmu_build.build(f"HydraulicTestBench.{self.model}", fmi=fmi))

    def reference(self) -> Array:
        """Stored results (n_t, n_outputs)."""
        rows = read_csv(FOLDER / f"{self.name}.csv")
        return np.array([[float(row[name]) for name in self.outputs] for row in rows])

    def tight(self) -> Array:
        """The same by the native loop at tight tolerance, FMI 2."""
        inputs = {name: Signal.steps([0.0], [value]) for name, value in self.inputs.items()}
        experiment = Experiment(self.times, self.outputs, inputs)
        return simulate(read_model(self.build(2)), experiment, solver=Rodas(rtol=1e-9, atol=1e-9)).values

    def off(self, values: Array) -> float:
        """Largest difference from the reference, as a share of the output's range."""
        reference = self.reference()
        return float((np.abs(values - reference).max(axis=0) / np.ptp(reference, axis=0)).max())


EXPORTED = (
    Exported("pump", "Pump.FreeGreyBox", ("alphaPercent", "u"), {"alphaCMD": 40.0, "alphaCMD_t": 0.0}),
    Exported("stepped-sine", "Examples.SteppedSine", ("pump.alphaPercent", "pump.u"), {}, events=True, at_rest=True),
    Exported(
        "test-bench", "LoadCircuit.TestBench", ("contOmega", "pL"), {"omegaS_ref": 20.0, "pL_ref": 20e5}, events=True
    ),
)
