"""`--input`: what drives a model's inputs."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

from pysim.cli.option import text

if TYPE_CHECKING:
    from pysim.cli.command import Given
    from pysim.types import Model, Signal


INPUT = text(
    "--input",
    "NAME=VALUE",
    "drive an input by a constant or by FILE.csv with columns time (s) and value, straight lines between; repeat",
    repeated=True,
)


def read_inputs(given: Given, model: Model) -> dict[str, Signal]:
    """Input -> signal, in the input's unit.

    Raises:
        BadInput: no NAME=, an unknown name, a number that is not finite, or a file that holds no signal.
    """
    from pysim.types import BadInput

    signals = {}
    for words in given.input:
        name, equals, value = (part.strip() for part in words.partition("="))
        if not (name and equals and value):
            raise BadInput(f"--input {words}: write NAME=NUMBER or NAME=FILE.csv")
        if name in signals:
            raise BadInput(f"--input {words}: {name} is driven already; give each input once")
        signals[model[name].name] = _signal(words, value)
    return signals


def input_files(given: Given) -> list[Path]:
    """Those that drive an input."""
    values = (Path(words.partition("=")[2].strip()) for words in given.input)
    return [path for path in values if path.is_file()]


def _signal(words: str, value: str) -> Signal:
    from pysim.cli.options import point_in_place
    from pysim.io import read_signal
    from pysim.types import BadInput, Signal

    try:
        number = float(value)
    except ValueError:
        if point_in_place(value) and not Path(value).exists():
            raise BadInput(f"--input {words}: write the number with a point: {value.replace(',', '.')}") from None
        return read_signal(Path(value), f"--input {words}")
    if not math.isfinite(number):
        raise BadInput(f"--input {words}: {value} is not finite; write a number in the input's unit")
    return Signal.constant(number)
