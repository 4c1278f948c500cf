"""`pysim signal KIND`: a file that any bench can play, and a picture of it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from pysim.cli.command import DONE, Command, Given
from pysim.cli.option import Option, Role, choice, file, number, switch, text
from pysim.cli.options import PLAN

if TYPE_CHECKING:
    from pysim.excitation import Excitation, LeadIn
    from pysim.present.excitation import Played


def _made(given: Given, test: Excitation) -> Played:
    """What the file will hold, which is written last: with its page, or not at all."""
    from pysim.io import signal_times
    from pysim.present.excitation import Played

    _refuse_slow_sampling(test, given.sampling)
    given.typed |= _places(given)
    signal_times(given.file, test.duration, given.sampling)  # refused before anything is shown
    about = given.command.about.rstrip(".")
    return Played(given.file, given.command.name, about, test, given.unit, given.sampling, _settings(given))


def _places(given: Given) -> dict[str, Path | None]:
    """The file, and the folder of its report; elsewhere the option of the one result is --output.

    Raises:
        BadInput: no file is named, or nothing can be written there.
    """
    from pysim.cli.outputs import prepare_answer, prepare_file
    from pysim.types import BadInput

    path, folder = given.file, given.output
    if path is None and folder is not None and folder.suffix.lower() == ".csv":
        path, folder = folder, None
    if path is None:
        raise BadInput("name the file to write, -o FILE.csv")
    prepare_file(path, "-o", (".csv",))
    if folder is not None:
        prepare_answer(folder, data=[], read=[], beside=[path])
    return {"file": path, "output": folder}


def _write(_given: Given, played: Played) -> None:
    from pysim.io import write_signal

    write_signal(
        played.test.signal(),
        played.file,
        duration=played.test.duration,
        unit=played.unit,
        sampling_hz=played.sampling_hz,
        title=played.settings,
    )


def _refuse_slow_sampling(test: Excitation, sampling_hz: float) -> None:
    """Rows further apart than half a period would be another signal."""
    from pysim.types import BadInput

    if test.highest_hz > 0 and not sampling_hz > 2 * test.highest_hz:
        raise BadInput(
            f"--sampling {sampling_hz:g}: so few rows per second do not show {test.highest_hz:.4g} Hz; give more than "
            f"twice that, or ten times to keep the shape"
        )


def _settings(given: Given) -> str:
    """The line that makes it again, with all of them, so that the file tells what it is."""
    from pysim.workflow import command_line

    values = ((option, given.typed[option.key]) for option in given.command.options)
    parsed = ((one, value if isinstance(value, bool | None) else [(str(value), value)]) for one, value in values)
    return command_line(["signal", given.command.name, *(word for one, value in parsed for word in one.words(value))])


def _lead(given: Given) -> LeadIn:
    from pysim.excitation import LeadIn

    return LeadIn(given.rest, given.ramp, given.hold, given.ramp_down)


def _stepped_sine(given: Given) -> Played:
    from pysim.excitation import SteppedSineCommand

    sine = (given.offset, given.amplitude, given.frequency, given.periods)
    return _made(given, SteppedSineCommand(*sine, _lead(given)))


def _chirp(given: Given) -> Played:
    from pysim.excitation import Chirp

    sweep = (given.offset, given.amplitude, given.start_hz, given.stop_hz, given.sweep)
    return _made(given, Chirp(*sweep, _lead(given)))


def _stochastic(given: Given) -> Played:
    from pysim.excitation import PiersonMoskowitz, StochasticWave

    spectrum = PiersonMoskowitz(given.height, given.peak_period)
    wave = (spectrum, given.length, given.seed, given.components, given.offset)
    return _made(given, StochasticWave(*wave, lead=_lead(given)))


def _step(given: Given) -> Played:
    from pysim.excitation import Step

    return _made(given, Step(given.offset, given.height, given.length, given.back, _lead(given)))


def _multisine(given: Given) -> Played:
    from pysim.excitation import LineGrid, Multisine
    from pysim.types import BadInput

    if (given.rms is None) == (given.peak is None):
        raise BadInput("one of the arguments --rms --peak is required; give the level by one of them")
    grid = LineGrid(given.period, given.low_hz, given.high_hz, given.lines)
    more = {"offset": given.offset, "periods": given.periods, "lead": _lead(given)}
    return _made(given, Multisine(grid, given.seed, rms=given.rms, peak=given.peak, **more))


def _needed(flag: str, unit: str, about: str) -> Option:
    return number(flag, unit, None, about, required=True)


_AMPLITUDE = _needed("--amplitude", "A", "amplitude of the sine, in the command's unit")
_SEED = number("--seed", "N", 0, "random seed of the phases", convert=int)


def _plan(given: Given) -> int:
    """Every command of a plan, and where its logs are to lie."""
    from pysim.bench import read_plan, write_commands

    plan = read_plan(given.plan)
    written = write_commands(plan, given.into, form=given.form, logs=given.logs, sampling_hz=given.sampling)
    print(f"{plan.name}: {len(written) - 2} commands in {given.into}, which {written[-2]} lists")
    print(f"Put the logs where it says, then: pysim data check {given.into}")
    return DONE


_SHARED = (
    number("--offset", "LEVEL", 0.0, "offset of the command, in its unit"),
    number("--rest", "SECONDS", 0.5, "rest at zero before the test"),
    number("--ramp", "SECONDS", 0.5, "ramp to the offset"),
    number("--hold", "SECONDS", 1.0, "hold at the offset"),
    number("--ramp-down", "SECONDS", 0.5, "ramp back to zero"),
    text("--unit", "UNIT", "unit of the command", default="%"),
    number("--sampling", "HZ", 1000.0, "rows per second"),
    Option(("-o", "--file"), "file for time, value and rate; required", "FILE.csv", convert=Path, role=Role.FILE),
    file("--output", "DIR", "write the picture and report.html here; a .csv is taken as --file", role=Role.PLACE),
)


def _kind(name: str, about: str, run: Callable[[Given], Played], *options: Option) -> Command:
    """A signal with its own options, ahead of those that all have."""
    return Command(name, about, run, options=(*options, *_SHARED), done=_write)


COMMAND = Command(
    "signal",
    "Make a test signal: a file any bench can play, and a picture of it.",
    parts=(
        _kind(
            "stepped-sine",
            "one sine around an offset (thesis Eq. 2.1)",
            _stepped_sine,
            _AMPLITUDE,
            _needed("--frequency", "HZ", "its frequency"),
            number("--periods", "N", 10.0, "number of periods"),
        ),
        _kind(
            "chirp",
            "a sine of linearly changing frequency (thesis Eq. 2.2)",
            _chirp,
            _AMPLITUDE,
            number("--start-hz", "HZ", 0.1, "first frequency"),
            number("--stop-hz", "HZ", 30.0, "last frequency"),
            _needed("--sweep", "SECONDS", "duration of the sweep"),
        ),
        _kind(
            "stochastic",
            "a wave with the Pierson-Moskowitz spectrum (thesis Appendix A)",
            _stochastic,
            _needed("--height", "H", "significant height, in the command's unit"),
            _needed("--peak-period", "SECONDS", "peak period of the spectrum"),
            number("--length", "SECONDS", 30.0, "length of the wave"),
            number("--components", "N", 100, "number of sines", convert=int),
            _SEED,
        ),
        _kind(
            "step",
            "a step from one level to another",
            _step,
            _needed("--height", "H", "height of the step, of either sign, in the command's unit"),
            _needed("--length", "SECONDS", "time at each level"),
            switch("--back", "step back again"),
        ),
        _kind(
            "multisine",
            "a periodic sum of sines with random phases",
            _multisine,
            _needed("--period", "SECONDS", "its inverse is the distance of the lines"),
            number("--low-hz", "HZ", 0.1, "lowest line"),
            number("--high-hz", "HZ", 30.0, "highest line"),
            number("--rms", "LEVEL", None, "level without the offset, in the command's unit"),
            number("--peak", "LEVEL", None, "or the largest deviation from the offset, in the command's unit"),
            choice("--lines", "random-odd", ("full", "odd", "random-odd"), "kind of excited lines"),
            number("--periods", "N", 3.0, "number of periods"),
            _SEED,
        ),
        Command(
            "plan",
            "every command of a test plan, for LabVIEW or a signal generator, and the dataset.toml of its logs",
            _plan,
            options=(
                PLAN,
                file(
                    "--into",
                    "DIR",
                    "new folder for the commands and, later, the logs",
                    role=Role.PLACE,
                    required=True,
                ),
                choice("--form", "csv", ("csv", "tdms", "generator"), "time and value, or -1 to 1 for a generator"),
                choice("--logs", "tdms", ("tdms", "csv", "txt", "parquet"), "suffix of the logs to come"),
                number("--sampling", "HZ", 1000.0, "rows per second"),
            ),
        ),
    ),
)
