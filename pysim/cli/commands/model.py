"""`pysim model`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pysim.cli.command import Command, Given
from pysim.cli.options import JSON, LIBRARY, MODEL_FIRST

if TYPE_CHECKING:
    from pysim.present.model import Inside


def run(given: Given) -> Inside:
    """The model, its slots, and the effects that these take."""
    from pysim.present.model import Inside
    from pysim.workflow import inside

    known = inside(given.model, given.library)
    return Inside(given.model, known.class_name, known.slots, known.taken, tuple(given.library))


COMMAND = Command(
    "model",
    "Say what a model holds: inputs, outputs, parameters, slots, and the effects that its slots take.",
    run,
    options=(MODEL_FIRST, LIBRARY, JSON),
)
