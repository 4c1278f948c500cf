"""Where a flow stops rising and where a stop pushes, on a curve whose bend is known."""

import numpy as np
import pytest

from pysim.types import Record
from validation.thesis.figure_4_1.flow_test import contact, end_of_rise


def bent(at: float) -> Record:
    """A flow that rises with the command up to a bend, and a stop that pushes from there on."""
    command = np.linspace(80.0, 100.0, 201)
    values = np.column_stack([command, np.minimum(command, at), np.where(command > at, -50.0 * (command - at), 0.0)])
    return Record(command, values, ("alphaCMD", "Q", "f_stop"), ("%", "m3/s", "N"), origin="made up")


@pytest.mark.parametrize("at", [90.0, 95.2])
def test_the_bend_is_found_to_a_sample(at: float) -> None:
    assert end_of_rise(bent(at)) == pytest.approx(at, abs=0.11)
    assert contact(bent(at)) == pytest.approx(at, abs=0.11)


def test_a_straight_line_has_no_bend_and_no_contact() -> None:
    assert (end_of_rise(bent(101.0)), contact(bent(101.0))) == (100.0, 100.0)
