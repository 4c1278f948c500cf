"""`--input`: what drives a model's inputs."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pysim.types import Model, Signal


def add_inputs(parser: argparse.ArgumentParser) -> None:
    """`--input`, once for each input that is driven."""
    what = "drive an input by a constant or by FILE.csv with columns time (s) and value, straight lines between"
    parser.add_argument("--input", metavar="NAME=VALUE", action="append", default=[], help=what)


def read_inputs(args: argparse.Namespace, model: Model) -> dict[str, Signal]:
    """Input -> signal, in the input's unit.

    Raises:
        BadInput: no NAME=, an unknown name, a number that is not finite, or a file that holds no signal.
    """
    from pysim.types import BadInput

    signals = {}
    for text in args.input:
        name, equals, value = (part.strip() for part in text.partition("="))
        if not (name and equals and value):
            raise BadInput(f"--input {text}: write NAME=NUMBER or NAME=FILE.csv")
        if name in signals:
            raise BadInput(f"--input {text}: {name} is driven already; give each input once")
        signals[model[name].name] = _signal(text, value)
    return signals


def input_files(args: argparse.Namespace) -> list[Path]:
    """Those that drive an input."""
    values = (Path(text.partition("=")[2].strip()) for text in args.input)
    return [path for path in values if path.is_file()]


def _signal(text: str, value: str) -> Signal:
    from pysim.cli.options import point_in_place
    from pysim.io import read_signal
    from pysim.types import BadInput, Signal

    try:
        number = float(value)
    except ValueError:
        if point_in_place(value) and not Path(value).exists():
            raise BadInput(f"--input {text}: write the number with a point: {value.replace(',', '.')}") from None
        return read_signal(Path(value), f"--input {text}")
    if not math.isfinite(number):
        raise BadInput(f"--input {text}: {value} is not finite; write a number in the input's unit")
    return Signal.constant(number)
