"""`pysim rig step` and `pysim rig heave`."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from pysim.cli.command import Command, Given
from pysim.cli.option import Option, choice, number
from pysim.cli.options import JSON, OUTPUT

if TYPE_CHECKING:
    from pysim.control import CompensatedLoadController, LoadController
    from pysim.present.rig.heave import Heave
    from pysim.present.rig.steps import Steps
    from pysim.types import Experiment, Record

# s; the least time between two rows of a record, and a sampling time that is none for loops of a few hertz
_ROW, _COARSEST = 2e-3, 0.1
_RIG, _CRANE = "HydraulicTestBench.LoadCircuit.Rig", "HydraulicTestBench.Crane.IdealCompensation"


def _step(given: Given) -> Steps:
    """A step of the speed, and one of the load pressure at that speed."""
    from pysim.present.rig.steps import Steps
    from pysim.rig import StepTest, step_figures

    every = _row(given.dt)
    tests = (
        StepTest("speed", given.speed, at=2.0, length=given.length),
        StepTest("load", 1e5 * given.load, speed=given.speed, at=10.0, length=given.length),
    )
    records = tuple(_run(given, test.experiment(every=every), None, f"step of {test.kind}") for test in tests)
    found = tuple((test, step_figures(record, test)) for test, record in zip(tests, records, strict=True))
    return Steps(found, records)


def _heave(given: Given) -> Heave:
    """The same wave under each load controller."""
    from pysim.present.rig.heave import Heave
    from pysim.rig import HeaveTest, heave_figures, load_controllers

    every = _row(given.dt)
    test = HeaveTest(given.height, given.period, given.length, given.seed)
    experiment = test.experiment(every=every)
    loads = load_controllers(given.dt)
    records = {label: _run(given, experiment, load, label, crane=True) for label, load in loads.items()}
    return Heave(test, {label: heave_figures(record, test) for label, record in records.items()}, records)


def _row(dt: float) -> float:
    """The least whole number of steps that is 2 ms or more, s.

    Raises:
        BadInput: a step that no controller of the rig can have.
    """
    from pysim.types import BadInput

    if not 0 < dt < _COARSEST:
        raise BadInput(f"--dt {dt:g}: give seconds, more than none and less than {_COARSEST:g}")
    return dt * max(1, math.ceil(_ROW / dt - 1e-6))


def _run(
    given: Given,
    experiment: Experiment,
    load: LoadController | CompensatedLoadController | None,
    title: str,
    *,
    crane: bool = False,
) -> Record:
    from pysim.cosim import cosimulate
    from pysim.cosim.members import Fmu
    from pysim.present.progress import Working, announce_compilation
    from pysim.rig import rig_member, rig_system
    from pysim.workflow import model_of

    def member(name: str) -> Any:
        with Working(f"Building {name}"):
            return model_of(name, fmi=given.fmi)

    announce_compilation()
    above = Fmu("crane", member(_CRANE), interface=given.interface) if crane else None
    rig = rig_member(member(_RIG), interface=given.interface)
    system = rig_system(rig, dt=given.dt, load=load, crane=above)
    end = float(experiment.times[-1])
    with given.progress(title) as bar:
        return cosimulate(system, experiment, step=given.dt, progress=lambda time: bar(round(time), round(end)))


_SHARED = (
    number("--dt", "SECONDS", 1e-3, "sampling time of the controllers, and step of the co-simulation"),
    Option(("--fmi",), "FMI version of the FMUs", "2|3", default=2, convert=int, choices=("2", "3")),
    choice("--interface", "co-simulation", ("co-simulation", "model-exchange"), "kind of FMU"),
    JSON,
    OUTPUT,
)

COMMAND = Command(
    "rig",
    "The thesis' test bench under its controllers: step tests, or heave compensation.",
    parts=(
        Command(
            "step",
            "A step of the shaft's speed, and one of the load pressure at that speed.",
            _step,
            options=(
                number("--speed", "RAD/S", 30.0, "size of the speed's step"),
                number("--load", "BAR", 40.0, "size of the load pressure's step, at that speed"),
                number("--length", "SECONDS", 30.0, "time after the step"),
                *_SHARED,
            ),
        ),
        Command(
            "heave",
            "Heave compensation: a vessel heaves in a random sea, and each load controller holds the payload still.",
            _heave,
            options=(
                number("--height", "M", 2.0, "significant height of the waves"),
                number("--period", "SECONDS", 10.0, "peak period of the waves"),
                number("--seed", "N", 1, "random seed of the waves", convert=int),
                number("--length", "SECONDS", 60.0, "time in the waves, after 3 s at rest"),
                *_SHARED,
            ),
        ),
    ),
)
