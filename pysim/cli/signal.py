"""Make a test signal: a file any bench can play, and a picture of it."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pysim.excitation import Excitation, LeadIn
    from pysim.types import Signal

_KINDS = {
    "stepped-sine": "one sine around an offset (thesis Eq. 2.1)",
    "chirp": "a sine of linearly changing frequency (thesis Eq. 2.2)",
    "stochastic": "a wave with the Pierson-Moskowitz spectrum (thesis Appendix A)",
    "step": "a step from one level to another",
    "multisine": "a periodic sum of sines with random phases",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The words behind `pysim signal`."""
    kinds = parser.add_subparsers(dest="kind", required=True, metavar="KIND")
    for kind, what in _KINDS.items():
        one = kinds.add_parser(kind, help=what, description=what)
        _add_settings(one, kind)
        _add_common(one)


def _add_settings(parser: argparse.ArgumentParser, kind: str) -> None:
    """What only this kind of signal has."""

    def number(name: str, what: str, default: float | None = None) -> None:
        words = what if default is None else f"{what} ({default:g})"
        parser.add_argument(name, type=float, required=default is None, default=default, help=words)

    if kind in ("stepped-sine", "chirp"):
        number("--amplitude", "of the sine, in the command's unit")
    if kind == "stepped-sine":
        number("--frequency", "Hz")
        number("--periods", "how many", 10.0)
    elif kind == "chirp":
        number("--start-hz", "frequency at its start", 0.1)
        number("--stop-hz", "frequency at its end", 30.0)
        number("--sweep", "s from the one to the other")
    elif kind == "stochastic":
        number("--height", "significant height, in the command's unit")
        number("--peak-period", "s")
        number("--length", "s of the wave", 30.0)
        parser.add_argument("--components", type=int, default=100, help="how many sines (100)")
    elif kind == "step":
        number("--height", "of the step, either sign, in the command's unit")
        number("--length", "s at each level")
        parser.add_argument("--back", action="store_true", help="step back again")
    else:
        _add_multisine(parser, number)
    if kind in ("stochastic", "multisine"):
        parser.add_argument("--seed", type=int, default=0, help="of the random phases (0)")


def _add_multisine(parser: argparse.ArgumentParser, number: Callable[..., None]) -> None:
    number("--period", "s; its inverse is the distance of the lines")
    number("--low-hz", "lowest line", 0.1)
    number("--high-hz", "highest line", 30.0)
    level = parser.add_mutually_exclusive_group(required=True)
    level.add_argument("--rms", type=float, help="level without the offset, in the command's unit")
    level.add_argument("--peak", type=float, help="largest deviation from the offset, in the command's unit")
    parser.add_argument("--lines", choices=("full", "odd", "random-odd"), default="random-odd", help="(random-odd)")
    number("--periods", "how many", 3.0)


def _add_common(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--offset", type=float, default=0.0, help="what the command is around, in its unit (0)")
    for name, what in (
        ("rest", "s at zero before"),
        ("ramp", "s to the offset"),
        ("hold", "s there"),
        ("ramp-down", "s back to zero"),
    ):
        default = 1.0 if name == "hold" else 0.5
        parser.add_argument(f"--{name}", type=float, default=default, metavar="SECONDS", help=f"{what} ({default:g})")
    parser.add_argument("--unit", default="%", help="of the command, for header and picture (%%)")
    parser.add_argument("--sampling", metavar="HZ", type=float, default=1000.0, help="rows per second (1000)")
    parser.add_argument("-o", "--file", metavar="FILE.csv", type=Path, help="time, value and rate; needed")
    parser.add_argument(
        "--output", metavar="DIR", type=Path, help="write the picture and report.html here; a .csv is taken as --file"
    )


def _choose_file(args: argparse.Namespace) -> None:
    """Elsewhere the option of the one result is --output.

    Raises:
        BadInput: no file is named.
    """
    from pysim.types import BadInput

    if args.file is None and args.output is not None and args.output.suffix.lower() == ".csv":
        args.file, args.output = args.output, None
    if args.file is None:
        raise BadInput("name the file to write, -o FILE.csv")


def run(args: argparse.Namespace) -> int:
    """Write the file, and say what is in it."""
    from pysim.cli.outputs import prepare_file, prepare_folder
    from pysim.io import write_signal

    _choose_file(args)
    test = _excitation(args)
    _refuse_slow_sampling(test, args.sampling)
    prepare_file(args.file, "-o", (".csv",))
    if args.output:
        prepare_folder(args.output)
    drawn = _drawn(args, test) if args.output else None  # before anything is written: all of it comes, or nothing
    write_signal(
        test.signal(), args.file, duration=test.duration, unit=args.unit, sampling_hz=args.sampling, title=_title(args)
    )
    print(f"{args.file}: {_KINDS[args.kind]}")
    for line in _facts(test, args):
        print(f"  {line}")
    if drawn:
        _write_report(args, test, *drawn)
    return 0


def _refuse_slow_sampling(test: Excitation, sampling_hz: float) -> None:
    """Rows further apart than half a period would be another signal."""
    from pysim.types import BadInput

    if test.highest_hz > 0 and not sampling_hz > 2 * test.highest_hz:
        raise BadInput(
            f"--sampling {sampling_hz:g}: so few rows per second do not show {test.highest_hz:.4g} Hz; give more than "
            f"twice that, or ten times to keep the shape"
        )


def _excitation(args: argparse.Namespace) -> Excitation:
    from pysim import excitation as make

    lead = _lead(args)
    if args.kind == "stepped-sine":
        return make.SteppedSineCommand(args.offset, args.amplitude, args.frequency, args.periods, lead)
    if args.kind == "chirp":
        return make.Chirp(args.offset, args.amplitude, args.start_hz, args.stop_hz, args.sweep, lead)
    if args.kind == "step":
        return make.Step(args.offset, args.height, args.length, args.back, lead)
    if args.kind == "stochastic":
        spectrum = make.PiersonMoskowitz(args.height, args.peak_period)
        return make.StochasticWave(spectrum, args.length, args.seed, args.components, args.offset, lead=lead)
    grid = make.LineGrid(args.period, args.low_hz, args.high_hz, args.lines)
    level = {"rms": args.rms, "peak": args.peak}
    return make.Multisine(grid, args.seed, **level, offset=args.offset, periods=args.periods, lead=lead)


def _lead(args: argparse.Namespace) -> LeadIn:
    from pysim.excitation import LeadIn

    return LeadIn(args.rest, args.ramp, args.hold, args.ramp_down)


def _title(args: argparse.Namespace) -> str:
    """The settings in one line, so that the file tells what it is."""
    skip = {"words", "command", "kind", "file", "output"}
    settings = (f"{key} {value}" for key, value in vars(args).items() if key not in skip and value is not None)
    return f"{args.kind}: {', '.join(settings)}"


def _facts(test: Excitation, args: argparse.Namespace) -> list[str]:
    """What a person at the bench wants to know before it is played: levels, jumps, and the speed between these."""
    import numpy as np

    signal = test.signal()
    t = np.arange(max(1, math.floor((test.end - test.onset) * args.sampling))) / args.sampling + test.onset
    value, fastest = signal.value(t), float(np.abs(signal.derivative(t)).max())
    unit = args.unit
    facts = [f"excitation from {test.onset:g} to {test.end:g} s, {test.duration:g} s in all"]
    if np.ptp(value) > 0:
        levels = f"from {value.min():.4g} to {value.max():.4g} {unit}"
        facts.append(f"mean {value.mean():.4g} {unit}, rms about it {value.std():.4g} {unit}, {levels}")
    jumps = [f"at {at:g} s from {before:.4g} to {behind:.4g} {unit}" for at, before, behind in _jumps(signal)]
    facts += [f"jumps {', '.join(jumps)}"] if jumps else []
    shown = f", its fastest sine in {args.sampling / test.highest_hz:.3g} rows per period" if test.highest_hz else ""
    return facts + ([f"fastest {fastest:.4g} {unit}/s{shown}"] if fastest > 0 else [])


def _jumps(signal: Signal) -> list[tuple[float, float, float]]:
    """Time in s, value before and value behind, wherever the command jumps."""
    import numpy as np

    at = signal.starts[1:]
    before, behind = signal.value(np.nextafter(at, -np.inf)), signal.value(at)
    there = np.abs(behind - before) > 1e-6 * np.abs([before, behind]).max(initial=0.0)
    return list(zip(at[there].tolist(), before[there].tolist(), behind[there].tolist(), strict=True))


def _drawn(args: argparse.Namespace, test: Excitation) -> tuple[bytes, bytes, str]:
    """The picture as PNG and as SVG, and what it shows."""
    from pysim.plot import excitation_figure, render

    figure = excitation_figure(test, args.unit)
    spectrum = ", and its spectrum" if len(figure.axes) > 1 else ""
    caption = f"The command over time, the excitation proper shaded{spectrum}."
    return render(figure, "png"), render(figure, "svg"), caption


def _write_report(args: argparse.Namespace, test: Excitation, png: bytes, svg: bytes, caption: str) -> None:
    from pysim.io import write_file
    from pysim.report import heading, items, page, paragraph, picture

    name = args.kind.replace("-", "_")
    write_file(args.output / f"{name}.png", png)
    write_file(args.output / f"{name}.svg", svg)
    parts = [heading("What is played"), items(_facts(test, args)), paragraph(_title(args)), picture(svg, caption)]
    write_file(args.output / "report.html", page(f"Test signal: {args.kind}", _KINDS[args.kind], parts))
    print(f"Report: {args.output / 'report.html'}")
