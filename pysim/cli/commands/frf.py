"""`pysim frf`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pysim.cli.command import Command, Given
from pysim.cli.option import number
from pysim.cli.options import DATASET, JSON, OUTPUT, REFERENCE_HZ, SIGNAL

if TYPE_CHECKING:
    from pysim.present.frf import Responses


def run(given: Given) -> Responses:
    """The responses of every offset and amplitude."""
    from pysim.identify import Window, measured_responses
    from pysim.present.frf import Responses
    from pysim.workflow import reference_of

    window = Window(given.settle_periods, given.settle)
    responses = tuple(measured_responses(given.dataset, output=given.signal, window=window))
    reference_hz = reference_of((one.response for one in responses), given.reference_hz)
    return Responses(given.dataset.name, responses, reference_hz)


COMMAND = Command(
    "frf",
    "Frequency responses from the stepped-sine logs of a data set.",
    run,
    options=(
        DATASET,
        SIGNAL,
        REFERENCE_HZ,
        number("--settle", "SECONDS", 0.5, "shortest transient to leave out, s"),
        number("--settle-periods", "N", 1.0, "shortest transient to leave out, in periods of the sine"),
        JSON,
        OUTPUT,
    ),
)
