"""What the table is made of: worst numbers by use, and a black box that is the right one over time."""

from types import SimpleNamespace

import numpy as np
import pytest

from pysim.identify import TransferFunction
from pysim.identify.accuracy import MAX_TIME, MEAN_TIME
from pysim.types import Deviation, Record
from validation.accuracy.judged import ANGLE, FIT, HELD_OUT, STEADY, VALVE, Judged, Row, table
from validation.accuracy.transfer import nearest, over_time


def row(what: str, use: str, mean: float, largest: float) -> Row:
    return Row(what, use, (Deviation(MEAN_TIME, mean), Deviation(MAX_TIME, largest)))


MODEL = Judged(
    "free",
    (
        row("a: u", FIT, 1.0, 4.0),
        row("b: u", FIT, 1.5, 3.0),
        row("c: u", HELD_OUT, 2.5, 9.0),
        row("c: alphaPercent", HELD_OUT, 0.5, 1.0),
        Row("d: alphaPercent", HELD_OUT, (Deviation(STEADY, 0.01),)),
    ),
)


def test_the_worst_of_each_use_and_signal_counts() -> None:
    assert MODEL.worst(MEAN_TIME, FIT, VALVE) == 1.5
    assert MODEL.worst(MAX_TIME, FIT, VALVE) == 4.0
    assert MODEL.worst(MEAN_TIME, HELD_OUT, ANGLE) == 0.5
    assert MODEL.worst(MEAN_TIME, FIT, ANGLE) is None


def test_the_table_marks_what_is_beyond_its_limit() -> None:
    head, limits, fitted, held = table([MODEL])
    assert [len(line) for line in (limits, fitted, held)] == [len(head)] * 3
    valve = head.index("E_t mean valve (%)")
    assert limits[valve] == "2"
    assert fitted[valve] == "1.50"
    assert held[valve] == "**2.50**"
    assert fitted[head.index("E_ss angle (%)")] == "-"
    assert held[head.index("E_ss angle (%)")] == "0.01"


def test_a_black_box_runs_from_rest_at_the_first_command() -> None:
    time = np.linspace(2.0, 3.0, 251)
    since = time - 2.0
    command = 10.0 + 5.0 * since
    angle = over_time(Record(time, command[:, None], ("alphaCMD",), ("%",)), TransferFunction((0.8,), (0.1, 1.0)))
    expected = 0.8 * (10.0 + 5.0 * (since - 0.1 * (1.0 - np.exp(-since / 0.1))))  # a first-order lag behind a ramp
    np.testing.assert_allclose(angle, expected, rtol=1e-9)


@pytest.mark.parametrize(("place", "found"), [((60.0, 10.0), (50.0, 5.0)), ((26.0, 90.0), (25.0, 10.0))])
def test_the_nearest_working_point_is_that_of_the_nearest_offset(place, found) -> None:
    points = [
        SimpleNamespace(measured=SimpleNamespace(test=SimpleNamespace(offset=offset, amplitude=amplitude)))
        for offset, amplitude in ((25.0, 10.0), (50.0, 20.0), (50.0, 5.0))
    ]
    test = nearest(points, *place).measured.test
    assert (test.offset, test.amplitude) == found
