"""All cases by name."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from importlib import import_module
from types import MappingProxyType
from typing import TYPE_CHECKING

from validation.findings import Finding

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True)
class Case:
    """A module with `run() -> Iterable[Finding]`, imported only when it is run.

    It may have `pictures() -> Mapping[str, Figure]` by caption, and `notes() -> Sequence[str]`, for the page.
    """

    module: str
    about: str
    group: str = "methods"  # one of GROUPS
    quick: bool = False  # run at every change: 10 s of CPU at most once compiled, and no claim about speed

    @property
    def readme(self) -> str:
        """The page that states source and tolerance, from the folder of this module."""
        return "/".join([*self.module.split(".")[1:-1], "README.md"])

    def run(self) -> Iterable[Finding]:
        """Findings, one by one as they come."""
        findings: Iterable[Finding] = import_module(self.module).run()
        return findings

    def pictures(self) -> Mapping[str, Figure]:
        """Figures by caption; none where the module has none."""
        draw = getattr(import_module(self.module), "pictures", None)
        figures: Mapping[str, Figure] = draw() if draw is not None else {}
        return figures

    def notes(self) -> tuple[str, ...]:
        """What a reader has to know of the results, such as what stood in for measurements."""
        tell = getattr(import_module(self.module), "notes", None)
        return tuple(tell()) if tell is not None else ()


GROUPS: Mapping[str, str] = MappingProxyType(
    {
        "thesis": "What the thesis published",
        "fmus": "FMUs as an importer sees them",
        "methods": "Methods on known answers",
        "diagnosis": "Diagnosis",
        "circuits": "Circuits and the test bench",
        "speed": "Speed and cost",
    }
)


_THESIS = "validation.thesis."

CASES: Mapping[str, Case] = MappingProxyType(
    {
        "pump-frequency": Case(
            "validation.pump_frequency.case",
            "FMU against the independent simulation, every point",
            "thesis",
            quick=True,
        ),
        "pump-time": Case(
            "validation.pump_time.case",
            "FMU against the independent simulation over time, ME and CS",
            "fmus",
            quick=True,
        ),
        "demo-table": Case(
            "validation.demo_table.case", "the demo against the independent result and the thesis", "thesis", quick=True
        ),
        "native-loop": Case(
            "validation.benchmarks.native_loop", "time and accuracy against FMPy's CVODE loop", "speed"
        ),
        "blackbox-coverage": Case(
            "validation.blackbox.case", "Table 4.1 comes back; 95 % intervals hold the truth", "methods"
        ),
        "effect-pairs": Case(
            "validation.effects.case", "every two effects of the catalogue build, vanish and run", "fmus"
        ),
        "friction": Case(
            "validation.friction.case", "thesis Table 6.2 found again from ten pulses per revolution", "methods"
        ),
        "chirp": Case(
            "validation.chirp.case", "one chirp against stepped sines on a model whose directions differ", "methods"
        ),
        "multisine": Case(
            "validation.multisine.case", "gain, noise, even and odd distortion where theory knows them", "methods"
        ),
        "virtual-bench": Case(
            "validation.virtual_bench.case",
            "the virtual bench against an independent plant's logs",
            "methods",
            quick=True,
        ),
        "pump-flow": Case(
            "validation.pump_flow.case",
            "mean flow and ripple of the pump: known numbers and the FMU",
            "thesis",
            quick=True,
        ),
        "ripple": Case("validation.ripple.case", "the pump's ripple behind a hose and at a relief valve", "circuits"),
        "load-circuit": Case(
            "validation.load_circuit.case", "linear models, energy and controllers of the test bench", "circuits"
        ),
        "rig-diagnosis": Case(
            "validation.rig_diagnosis.case",
            "the test bench's missing friction is named and added, and nothing where nothing is missing",
            "diagnosis",
        ),
        "known-answers": Case("validation.known_answers.case", "pump and test bench, answers known", "diagnosis"),
        "tuning": Case(
            "validation.tuning.case", "which gains of Table 6.1 follow from plants and margins", "circuits", quick=True
        ),
        "libcosim": Case(
            "validation.libcosim.case",
            "the test bench as three FMUs under libcosim, wired and as .ssp",
            "circuits",
            quick=True,
        ),
        "cosim-speed": Case(
            "validation.benchmarks.cosim_speed", "a co-simulation step beside FMPy's and libcosim's", "speed"
        ),
        "cosim": Case(
            "validation.cosim.case",
            "co-simulation against closed forms and a monolithic rig; cost of a step",
            "circuits",
        ),
        "rig-control": Case(
            "validation.rig_control.case",
            "the rig under Python controllers: every way alike, steps, heave, cost",
            "circuits",
        ),
        "examples": Case(
            "validation.examples.case",
            "every model that runs by itself against another solver's stored result",
            "circuits",
        ),
        "kernel": Case(
            "validation.kernel.case",
            "runs and slopes of every model that runs by itself, and of FMUs of others, against FMPy's CVODE",
            "fmus",
        ),
        "every-class": Case(
            "validation.examples.every_class", "every model and block of the library compiles", "circuits"
        ),
        "fit-bench-01": Case(
            "validation.fit_bench.case", "an independent plant's logs fitted to their noise", "methods"
        ),
        "fit-cost": Case(
            "validation.benchmarks.case",
            "a fit of 342 sines and two waves, and one of many rows: ratios to plain ways, memory, two cores, Dask",
            "speed",
        ),
        "fit-thesis": Case("validation.fit_thesis.case", "the fits of thesis Section 4.4 done again", "thesis"),
        "accuracy": Case(
            "validation.accuracy.case",
            "black box, locked, free and diagnosed model of one pump under thesis Tables 1.3 and 1.4",
            "thesis",
        ),
        "fit-coverage": Case(
            "validation.fit_coverage.case", "95 percent intervals hold the truth; held-out error", "methods"
        ),
        "interval-coverage": Case(
            "validation.fit_coverage.mass",
            "95 percent intervals of 1600 fits of a fast model: white and coloured noise, from rest and in motion",
            "methods",
        ),
        "initial-states": Case(
            "validation.initial_states.case",
            "logs that begin in motion: mass, pump, an FMU of which only outputs are known",
            "methods",
        ),
        "sensitivity": Case(
            "validation.sensitivity.case", "exact derivatives of a whole fit against differences", "methods"
        ),
        "blind-plant": Case(
            "validation.blind.proof", "the blind benchmark's plant against another and the FMU", "diagnosis"
        ),
        "blind-effects": Case(
            "validation.blind.catalogue", "18 effects: Modelica classes against the blind plant", "diagnosis"
        ),
        "blind-benchmark": Case(
            "validation.blind.benchmark.case",
            "twelve of 240 blind cases of a seed, or all that this commit has answered",
            "diagnosis",
        ),
        "nulls": Case(
            "validation.nulls.case",
            "300 complete models: coloured noise, motion at the start, noise not or wrongly stated",
            "diagnosis",
        ),
        "ties": Case(
            "validation.ties.case", "ties of a diagnosis, each put to the test that it came with", "diagnosis"
        ),
        "diagnosis": Case(
            "validation.diagnosis.case",
            "ten data sets of another author's plant whose truth is known: five of them, others each day",
            "diagnosis",
        ),
        "real-measurements": Case(
            "validation.real_measurements.case", "why the locked model cannot fit; the load", "diagnosis"
        ),
        "plate-pull": Case(
            "validation.plate_pull.case",
            "the pistons' pull on the swash plate beside what load changed",
            "thesis",
            quick=True,
        ),
        "real-machines": Case(
            "validation.real.case",
            "five measured machines: base models and right effects against independent least squares",
            "diagnosis",
        ),
        "mismatch": Case(
            "validation.mismatch.case",
            "laws of another shape than the catalogue's: names in order, and the error on a log that is withheld",
            "diagnosis",
        ),
        "learned": Case(
            "validation.learned.case",
            "fifteen laws that no catalogue holds: places, variables, and the error on a wave not given",
            "diagnosis",
        ),
        "figure-2-1": Case(_THESIS + "figure_2_1.case", "command of a stepped-sine test", "thesis", quick=True),
        "figure-2-2": Case(_THESIS + "figure_2_2.case", "sines fitted to responses; Figure 2.3", "thesis", quick=True),
        "figure-2-4": Case(_THESIS + "figure_2_4.case", "Bode plot and five poles; Figure 2.5", "thesis", quick=True),
        "figure-3-9": Case(_THESIS + "figure_3_9.case", "ripple flow; Figures 3.10, 3.11", "thesis", quick=True),
        "figure-4-1": Case(_THESIS + "figure_4_1.case", "steady flow over the command", "thesis", quick=True),
        "figure-4-2": Case(_THESIS + "figure_4_2.case", "load against no load; Figure 4.3", "thesis", quick=True),
        "figure-4-4": Case(_THESIS + "figure_4_4.case", "chirp; Figures 2.6, 2.7, 4.5", "thesis", quick=True),
        "figure-4-6": Case(
            _THESIS + "figure_4_6.case", "models over time; Figure 4.7, Table 4.9", "thesis", quick=True
        ),
        "figure-5-15": Case(_THESIS + "figure_5_15.case", "heave of a vessel; Figure 5.16", "thesis", quick=True),
        "figure-6-1": Case(_THESIS + "figure_6_1.case", "both loops; Figure 6.2, Table 6.1", "thesis", quick=True),
        "figure-6-3": Case(_THESIS + "figure_6_3.case", "friction of both motors; Table 6.2", "thesis", quick=True),
        "appendix-a": Case(_THESIS + "appendix_a.case", "wave spectrum and a wave of it", "thesis", quick=True),
        "appendix-c": Case(_THESIS + "appendix_c.case", "Bode plots at every offset", "thesis", quick=True),
        "table-4-2": Case(_THESIS + "table_4_2.case", "pressure drop over the orifice", "thesis", quick=True),
        "table-4-4": Case(_THESIS + "table_4_4.case", "black boxes of a known plant", "thesis", quick=True),
        "table-5-1": Case(_THESIS + "table_5_1.case", "parameters of the linear models", "thesis", quick=True),
        "readers": Case("validation.readers.case", "10,000 spoiled inputs for each reader of files"),
        "mutations": Case(
            "validation.mutations.case", "40 faults planted in formulas of the thesis: a test notices each"
        ),
        "mirror": Case(
            "validation.mirror.case",
            "the pump block against Appendix F, name by name and sign by sign",
            "thesis",
            quick=True,
        ),
        "kills": Case("validation.kills.case", "37 kills of a build, a fit and a diagnosis: the same results"),
        "importers": Case("validation.importers.case", "what importers and the checker make of our FMUs", "fmus"),
    }
)
