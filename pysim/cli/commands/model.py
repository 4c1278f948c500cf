"""`pysim model`."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from pysim.cli._any_model import WHAT
from pysim.cli.command import Command, Given
from pysim.cli.option import argument
from pysim.cli.options import JSON, LIBRARY

if TYPE_CHECKING:
    from pysim.present.model import Inside


def run(given: Given) -> Inside:
    """The model, its slots, and the effects that these take."""
    from pysim.cli._subject import read_inside
    from pysim.present.model import Inside

    names = argparse.Namespace(model=given.model, library=given.library)
    return Inside(*read_inside(names), tuple(given.library))


COMMAND = Command(
    "model",
    "Say what a model holds: inputs, outputs, parameters, slots, and the effects that its slots take.",
    run,
    options=(argument("MODEL", WHAT), LIBRARY, JSON),
    view="pysim.present.model",
)
