"""All cases by name."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from importlib import import_module
from types import MappingProxyType

from validation.findings import Finding


@dataclass(frozen=True)
class Case:
    """A module with `run() -> Iterable[Finding]`, imported only when it is run."""

    module: str
    about: str

    def run(self) -> Iterable[Finding]:
        """Findings, one by one as they come."""
        findings: Iterable[Finding] = import_module(self.module).run()
        return findings


CASES: Mapping[str, Case] = MappingProxyType(
    {
        "pump-frequency": Case("validation.pump_frequency.case", "FMU against the independent simulation, every point"),
        "pump-time": Case("validation.pump_time.case", "FMU against the independent simulation over time, ME and CS"),
        "demo-table": Case("validation.demo_table.case", "the demo against the independent result and the thesis"),
        "native-loop": Case("validation.benchmarks.native_loop", "time and accuracy against FMPy's CVODE loop"),
        "blackbox-coverage": Case("validation.blackbox.case", "Table 4.1 comes back; 95 % intervals hold the truth"),
        "effect-pairs": Case("validation.effects.case", "every two effects of the catalogue build, vanish and run"),
        "friction": Case("validation.friction.case", "thesis Table 6.2 found again from ten pulses per revolution"),
        "chirp": Case("validation.chirp.case", "one chirp against stepped sines on a model whose directions differ"),
        "multisine": Case("validation.multisine.case", "gain, noise, even and odd distortion where theory knows them"),
        "virtual-bench": Case("validation.virtual_bench.case", "the virtual bench against an independent plant's logs"),
        "pump-flow": Case("validation.pump_flow.case", "mean flow and ripple of the pump: known numbers and the FMU"),
        "ripple": Case("validation.ripple.case", "the pump's ripple behind a hose and at a relief valve"),
        "load-circuit": Case("validation.load_circuit.case", "linear models, energy and controllers of the test bench"),
        "fit-bench-01": Case("validation.fit_bench.case", "an independent plant's logs fitted to their noise"),
        "fit-speed": Case("validation.fit_speed.case", "13 parameters, 342 sines and two waves, from 30 percent off"),
        "fit-thesis": Case("validation.fit_thesis.case", "the fits of thesis Section 4.4 done again"),
        "fit-coverage": Case("validation.fit_coverage.case", "95 percent intervals hold the truth; held-out error"),
        "sensitivity": Case("validation.sensitivity.case", "exact derivatives of a whole fit against differences"),
        "blind-plant": Case("validation.blind.proof", "the blind benchmark's plant against another and the FMU"),
        "blind-effects": Case("validation.blind.catalogue", "18 effects: Modelica classes against the blind plant"),
        "blind-benchmark": Case("validation.blind.benchmark.case", "six of 1090 blind cases again; targets on all"),
        "diagnosis": Case("validation.diagnosis.case", "sixteen data sets of another author's plant diagnosed"),
        "real-measurements": Case("validation.real_measurements.case", "why the locked model cannot fit; the load"),
        "slow-tests": Case("validation.slow_tests.case", "the tests that the test command leaves out"),
        "wine": Case("validation.wine.case", "the Windows binary under Wine against the binary of this machine"),
    }
)
