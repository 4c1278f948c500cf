"""The thesis' test bench under its controllers: step tests, or heave compensation."""

from __future__ import annotations

import argparse
import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from pysim.control import CompensatedLoadController, LoadController
    from pysim.types import Experiment, Record

# s; the least time between two rows of a record, and a sampling time that is none for loops of a few hertz
_ROW, _COARSEST = 2e-3, 0.1
_RIG, _CRANE = "HydraulicTestBench.LoadCircuit.Rig", "HydraulicTestBench.Crane.IdealCompensation"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The words behind `pysim rig`."""
    parser.add_argument("test", choices=["step", "heave"], help="steps of speed and load pressure, or a wave")
    parser.add_argument("--dt", metavar="SECONDS", type=float, default=1e-3, help="of controllers and coupling (0.001)")
    parser.add_argument("--fmi", type=int, choices=[2, 3], default=2, help="version of the FMUs (2)")
    parser.add_argument(
        "--interface", choices=["co-simulation", "model-exchange"], default="co-simulation", help="(co-simulation)"
    )
    parser.add_argument("--speed", metavar="RAD/S", type=float, default=30.0, help="step: its size (30)")
    parser.add_argument("--load", metavar="BAR", type=float, default=40.0, help="step: its size, at that speed (40)")
    parser.add_argument("--height", metavar="M", type=float, default=2.0, help="heave: significant height (2)")
    parser.add_argument("--period", metavar="SECONDS", type=float, default=10.0, help="heave: peak period (10)")
    parser.add_argument("--seed", type=int, default=1, help="heave: of the wave's phases (1)")
    parser.add_argument("--length", metavar="SECONDS", type=float, help="behind the step (30), or of the wave (60)")
    parser.add_argument("--json", metavar="FILE", type=Path, help="write all numbers here")
    parser.add_argument("-o", "--output", metavar="DIR", type=Path, help="write report.html and the plots here")


def run(args: argparse.Namespace) -> int:
    """Print a table of what the answers are worth."""
    from pysim.cli.outputs import JSON, prepare_file, prepare_folder
    from pysim.cli.progress import announce_compilation
    from pysim.types import BadInput

    if not 0 < args.dt < _COARSEST:
        raise BadInput(f"--dt {args.dt:g}: give seconds, more than none and less than {_COARSEST:g}")
    if args.output:
        prepare_folder(args.output)
    if args.json:
        prepare_file(args.json, "--json", JSON)
    announce_compilation()
    (_step if args.test == "step" else _heave)(args)
    return 0


def _step(args: argparse.Namespace) -> None:
    from pysim.plot.rig import rig_step_figure
    from pysim.report.rig import step_data, step_page, step_text
    from pysim.rig import StepTest, step_figures

    length = 30.0 if args.length is None else args.length
    tests = (
        StepTest("speed", args.speed, at=2.0, length=length),
        StepTest("load", 1e5 * args.load, speed=args.speed, at=10.0, length=length),
    )
    records = [_run(args, test.experiment(every=_row(args.dt)), None, f"step of {test.kind}") for test in tests]
    found = [(test, step_figures(record, test)) for test, record in zip(tests, records, strict=True)]
    print(step_text(found))
    figures = {
        f"step_{test.kind}": (f"Step of the {test.kind}; grey: 5 percent.", rig_step_figure(record, test))
        for test, record in zip(tests, records, strict=True)
        if args.output
    }
    _write(args, step_data(found), figures, lambda pictures, redo: step_page(found, pictures=pictures, redo=redo))


def _heave(args: argparse.Namespace) -> None:
    from pysim.plot.rig import rig_error_figure, rig_heave_figure
    from pysim.report.rig import heave_data, heave_page, heave_text
    from pysim.rig import HeaveTest, heave_figures

    test = HeaveTest(args.height, args.period, 60.0 if args.length is None else args.length, args.seed)
    experiment = test.experiment(every=_row(args.dt))
    records = {label: _run(args, experiment, load, label) for label, load in _load_controllers(args.dt).items()}
    found = {label: heave_figures(record, test) for label, record in records.items()}
    print(heave_text(found))
    first = next(iter(records))
    figures: dict[str, tuple[str, Figure]] = {}
    if args.output:
        caption = "Speed, load pressure and supply pressure under the thesis' controllers, and a reversal in detail."
        figures["heave"] = (caption, rig_heave_figure(records[first], test))
        figures["heave_error"] = ("Load-pressure error of each controller.", rig_error_figure(records))
    data = heave_data(found, test)
    _write(args, data, figures, lambda pictures, redo: heave_page(found, test, pictures=pictures, redo=redo))


def _row(dt: float) -> float:
    """The least whole number of steps that is 2 ms or more, s."""
    return dt * max(1, math.ceil(_ROW / dt - 1e-6))


def _load_controllers(dt: float) -> Mapping[str, LoadController | CompensatedLoadController]:
    """Before and after: the thesis', with its valve turned round, and that with the gain that calms the shaft."""
    from pysim.control import CompensatedLoadController, LoadController
    from pysim.control.tuning import damping_gain

    plain = LoadController(dt)
    gain = damping_gain(plain.T_i, speed=8.0)
    return {
        "thesis": plain,
        "compensated": CompensatedLoadController(dt),
        "gain for the shaft": LoadController(dt, K_p=gain),
        "both": CompensatedLoadController(dt, K_p=gain * 0.0035),
    }


def _run(
    args: argparse.Namespace,
    experiment: Experiment,
    load: LoadController | CompensatedLoadController | None,
    title: str,
) -> Record:
    import fmu_build
    from pysim.cli.progress import ProgressBar, Working
    from pysim.cosim import cosimulate
    from pysim.cosim.members import Fmu
    from pysim.io import read_model
    from pysim.rig import rig_member, rig_system

    def member(name: str) -> Any:
        with Working(f"Building {name}"):
            return read_model(fmu_build.build(name, fmi=args.fmi))

    crane = Fmu("crane", member(_CRANE), interface=args.interface) if args.test == "heave" else None
    rig = rig_member(member(_RIG), interface=args.interface)
    system = rig_system(rig, dt=args.dt, load=load, crane=crane)
    end = float(experiment.times[-1])
    with ProgressBar(title) as bar:
        return cosimulate(system, experiment, step=args.dt, progress=lambda time: bar(round(time), round(end)))


def _write(args: argparse.Namespace, data: Any, figures: Mapping[str, tuple[str, Figure]], make_page: Any) -> None:
    """Numbers, pictures and the page, where they were asked for."""
    from pysim.cli.outputs import repeating
    from pysim.io import write_file
    from pysim.present.render import render

    if args.json:
        write_file(args.json, json.dumps(data, indent=1, allow_nan=False))
    if not args.output:
        return
    pictures = {}
    for name, (caption, figure) in figures.items():
        write_file(args.output / f"{name}.png", render(figure, "png"))
        pictures[caption] = render(figure, "svg")
        write_file(args.output / f"{name}.svg", pictures[caption])
    write_file(args.output / "report.html", make_page(pictures, repeating(args)))
    print(f"Report: {args.output / 'report.html'}")
