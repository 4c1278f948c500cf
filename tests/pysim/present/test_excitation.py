"""The picture of a test signal shows its numbers."""

from pathlib import Path

import numpy as np
import pytest

import pysim.excitation
from pysim.excitation import (
    Chirp,
    Excitation,
    LeadIn,
    LineGrid,
    Multisine,
    PiersonMoskowitz,
    Step,
    SteppedSineCommand,
    StochasticWave,
)
from pysim.present.excitation import Played, excitation_figure, jumps, text
from tests.pysim.present.looking import numbers

FAMILY: list[Excitation] = [
    SteppedSineCommand(50.0, 10.0, 5.0, 7.0),
    SteppedSineCommand(0.0, 10.0, 5000.0, 0.5),  # shorter than two samples of a slow one
    Chirp(50.0, 10.0, 12.0, 26.0, 5.0),
    Step(20.0, 10.0, 2.0),
    Step(0.1, 0.2, 2.0),  # whose mean is not its level, by rounding
    Step(20.0, -10.0, 2.0, back=True),
    StochasticWave(PiersonMoskowitz(100.0, 1.0), 20.0, seed=2),
    Multisine(LineGrid(5.0, 0.1, 30.0), seed=1, rms=5.0),
]


def curve(figure, axes: int, line: int = 0) -> np.ndarray:
    return np.asarray(figure.axes[axes].get_lines()[line].get_xydata())


def test_the_family_is_complete() -> None:
    public = (getattr(pysim.excitation, name) for name in pysim.excitation.__all__)
    assert {type(test) for test in FAMILY} == {one for one in public if hasattr(one, "signal")} - {Excitation}


@pytest.mark.parametrize("test", FAMILY, ids=str)
def test_every_member_has_a_picture_that_can_be_read(test: Excitation) -> None:
    figure = excitation_figure(test, "%")
    t, y = curve(figure, 0).T
    np.testing.assert_allclose(y, test.signal().value(t))
    assert (t[0], t[-1]) == (0.0, test.duration)
    for axes in figure.axes:
        assert min(len(numbers(axis)) for axis in (axes.xaxis, axes.yaxis)) >= 3


def test_a_step_stands_alone_and_a_step_back_has_a_spectrum() -> None:
    (alone,) = excitation_figure(Step(20.0, 10.0, 2.0), "%").axes
    y = np.asarray(alone.get_lines()[0].get_ydata())
    assert {20.0, 30.0} <= set(y)  # the level before, and the one that is stepped to
    f, density = curve(excitation_figure(Step(20.0, 10.0, 2.0, back=True), "%"), 1).T
    assert np.sqrt(np.sum(density**2) * (f[1] - f[0])) == pytest.approx(5.0, rel=0.01)  # half the height, as rms


def test_time_course_of_a_long_fast_test_fills_its_band() -> None:
    test = SteppedSineCommand(50.0, 10.0, 75.0, 30_000.0)
    t, y = curve(excitation_figure(test, "%"), 0).T
    assert np.all(np.diff(t) >= 0)
    parts = np.digitize(t, np.linspace(test.onset + 10, test.end, 400))
    assert min(np.ptp(y[parts == k]) for k in range(1, 400)) > 0.95 * 20


def test_density_of_a_chirp_is_that_of_its_sweep() -> None:
    # A sweep spends 1/rate s per Hz: the power spectral density is A^2/2 per (stop - start).
    f, density = curve(excitation_figure(Chirp(50.0, 10.0, 0.5, 30.0, 200.0), "%"), 1).T
    middle = (f > 3) & (f < 25)
    assert np.sqrt(np.mean(density[middle] ** 2)) == pytest.approx(np.sqrt(100 / 2 / 29.5), rel=0.01)


def test_spectrum_of_a_long_fast_test_does_not_fold_back() -> None:
    f, density = curve(excitation_figure(Chirp(50.0, 10.0, 0.1, 200.0, 400.0), "%"), 1).T
    for low in (1, 40, 80, 120, 160):
        middle = (f > low) & (f < low + 38)
        assert np.sqrt(np.mean(density[middle] ** 2)) == pytest.approx(np.sqrt(100 / 2 / 199.9), rel=0.01)


def test_density_of_a_wave_follows_its_spectrum() -> None:
    test = StochasticWave(PiersonMoskowitz(100.0, 1.0), 600.0, seed=2, components=200)
    figure = excitation_figure(test, "%")
    f, density = curve(figure, 1).T
    _, theory = curve(figure, 1, 1).T
    assert np.sum(density**2) * (f[1] - f[0]) == pytest.approx(25.0**2, rel=0.15)
    bands = [(0.7, 1.0), (1.0, 1.5), (1.5, 3.0)]
    for low, high in bands:
        inside = (f > low) & (f < high)
        assert np.mean(density[inside] ** 2) == pytest.approx(np.mean(theory[inside] ** 2), rel=0.3)


def test_lines_of_a_multisine_are_drawn_with_those_left_out() -> None:
    test = Multisine(LineGrid(10.0, 0.1, 5.0), seed=1, rms=5.0)
    figure = excitation_figure(test, "%")
    segments = np.array(figure.axes[1].collections[0].get_segments())
    np.testing.assert_allclose(segments[:, 1, 0], test.grid.excited / 10.0)
    np.testing.assert_allclose(segments[:, 1, 1], test.waves()[:, 0])
    np.testing.assert_allclose(curve(figure, 1, 1)[:, 0], test.grid.odd_detection / 10.0)
    labels = [text.get_text() for text in figure.legends[0].get_texts()]
    assert labels == [f"{test.grid.excited.size} excited lines", "25 even lines left out", "6 odd lines left out"]


def test_a_command_without_an_end_is_drawn_for_a_minute() -> None:
    figure = excitation_figure(SteppedSineCommand(50.0, 10.0, 1.0, periods=np.inf), "%")
    assert curve(figure, 0)[-1, 0] == 62.0
    f, density = curve(figure, 1).T
    assert f[np.argmax(density)] == pytest.approx(1.0, abs=0.02)


@pytest.mark.parametrize(
    ("test", "expected"),
    [
        (Step(20.0, 10.0, 2.0), [(2, 20, 30)]),
        (Step(20.0, 10.0, 2.0, True, LeadIn(ramp=0.0)), [(0.5, 0, 20), (1.5, 20, 30), (3.5, 30, 20)]),
        (Chirp(0.0, 5.0, 0.1, 30.0, 5.0), []),
        (Step(0.0, 1.0, 0.0004), [(2.0, 0, 1)]),
    ],
)
def test_every_jump_is_known(test: Excitation, expected: list[tuple[float, float, float]]) -> None:
    """Rest 0.5 s, ramp 0.5 s, hold 1 s, then the step; a command of a single row has its facts too."""
    assert jumps(test.signal()) == [pytest.approx(jump) for jump in expected]
    shown = text(Played(Path("s.csv"), "kind", "about", test, "%", 1000.0, "settings"))
    assert ("jumps" in shown) == bool(expected)
