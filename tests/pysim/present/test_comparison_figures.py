"""Figures show the numbers they were given."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from pysim.identify import magnitude_db
from pysim.present import render, style
from pysim.present.comparison import bode_figure, deviation_figure
from pysim.present.style import new_figure
from pysim.types import BadInput, SineTest
from tests.pysim.comparisons import comparison

SETS = [comparison("A"), comparison("B", error_db=1.0, fails=1)]


def curves(figure: Figure, axes: int) -> list[np.ndarray]:
    return [np.asarray(line.get_ydata()) for line in figure.axes[axes].get_lines()]


def test_bode_has_a_column_per_amplitude_and_a_curve_per_response() -> None:
    figure = bode_figure(SETS, 50.0)
    assert len(figure.axes) == 4
    test = SETS[1].tests[2]
    measured, first, second = curves(figure, 0)
    np.testing.assert_allclose(measured, magnitude_db(test.measured))
    np.testing.assert_allclose(first, measured)
    assert test.simulated is not None
    np.testing.assert_allclose(second, magnitude_db(test.simulated))
    np.testing.assert_allclose(curves(figure, 2)[0], np.degrees(test.measured.phase))
    band = figure.axes[0].collections[0].get_paths()[0].get_extents()
    assert (band.y1, band.y0) == pytest.approx((measured.max() + 2.0, measured.min() - 2.0))


def test_bode_names_what_stands_for_the_measurements_and_takes_off_whole_turns() -> None:
    one = comparison("A")
    tests = tuple(
        replace(
            t, measured=replace(t.measured, phase=t.measured.phase + 2 * np.pi, origin="transfer function, Table 9")
        )
        for t in one.tests
    )
    figure = bode_figure([replace(one, tests=tests, reference_hz=None, command_unit="V")], 50.0)
    assert figure.legends[0].get_texts()[0].get_text() == "transfer function, Table 9"
    reference, simulated = curves(figure, 2)
    np.testing.assert_allclose(simulated, reference, atol=1e-9)
    assert figure.axes[0].get_ylabel() == "Magnitude (dB)"
    assert figure.axes[0].get_title() == "offset 50 V, amplitude 5 V"
    pressures = [replace(t, measured=replace(t.measured, test=SineTest(1e7, 2e6, "cmd", "angle"))) for t in tests]
    in_pascal = replace(one, tests=tuple(pressures), command_unit="Pa")
    assert bode_figure([in_pascal], 1e7).axes[0].get_title() == "offset 100 bar, amplitude 20 bar"
    rows = deviation_figure([in_pascal]).axes[0]
    assert (rows.get_yticklabels()[0].get_text(), rows.get_ylabel()) == ("100 / 20", "Offset / amplitude (bar)")


def test_bode_shows_the_range_of_every_test() -> None:
    """A large amplitude is often measured up to a lower frequency than a small one."""
    one = comparison("A")
    whole = [test for test in one.tests if test.measured.test.offset == 50.0]
    short = replace(
        whole[-1].measured, **{k: getattr(whole[-1].measured, k)[:3] for k in ("frequency", "gain", "phase")}
    )
    figure = bode_figure([replace(one, tests=(whole[0], replace(whole[-1], measured=short, simulated=None)))], 50.0)
    f = whole[0].measured.frequency
    assert all(axes.get_xlim() == pytest.approx((f[0], f[-1])) for axes in figure.axes)


def test_bode_leaves_out_what_did_not_run() -> None:
    assert len(curves(bode_figure(SETS, -50.0), 0)) == 2
    with pytest.raises(BadInput, match="no test at offset 7"):
        bode_figure(SETS, 7.0)


def test_deviations_tell_pass_from_fail() -> None:
    figure = deviation_figure(SETS)
    mean_db = figure.axes[0].get_lines()
    filled_a, hollow_a, filled_b, hollow_b = ([float(x) for x in line.get_xdata()] for line in mean_db[:4])
    np.testing.assert_allclose(filled_a, [0.0] * 4)
    assert hollow_a == filled_b == []
    np.testing.assert_allclose(hollow_b, [0.75] * 3)  # the fourth did not run
    assert mean_db[3].get_markerfacecolor() == "white"
    assert mean_db[4].get_xdata()[0] == 0.5


@pytest.mark.parametrize(("form", "begins"), [("png", b"\x89PNG\r\n\x1a\n"), ("svg", b"<?xml")])
def test_rendering_gives_the_same_bytes_twice(form: str, begins: bytes) -> None:
    figure = new_figure(1.0, 1.0)
    first = render(figure, form)
    assert first.startswith(begins)
    assert first == render(figure, form)


def test_no_global_plotting_state_is_touched() -> None:
    for path in Path(style.__file__).parent.glob("*.py"):
        assert not re.search(r"import.*pyplot|matplotlib\.pyplot", path.read_text("utf-8")), path.name
