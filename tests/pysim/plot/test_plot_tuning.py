import math

import numpy as np
import pytest

from pysim.control.tuning import fastest_pi, known_pi, load_pressure_plant, loop_response, shaft_speed_plant
from pysim.control.tuning.margins import open_loop
from pysim.plot.tuning import tuning_figure
from pysim.types import BadInput


def test_what_is_drawn_is_the_loop() -> None:
    gains = known_pi(load_pressure_plant(), 1.98e-9, 0.03)
    axes = tuning_figure({"manual": gains}, dt=1e-3).axes
    hertz, decibels = (np.asarray(x) for x in axes[0].lines[0].get_data())
    loop = open_loop(gains.plant, 1.98e-9, 0.03, 2 * np.pi * hertz)
    assert decibels == pytest.approx(20 * np.log10(np.abs(loop)))
    assert np.asarray(axes[1].lines[0].get_ydata()) == pytest.approx(20 * np.log10(np.abs(loop / (1 + loop))))
    dot = axes[0].lines[1].get_xdata()
    assert float(np.asarray(dot)[0]) == pytest.approx(gains.loop.crossover / (2 * math.pi))
    time, step = (np.asarray(x) for x in axes[2].lines[0].get_data())
    wanted = loop_response(gains.plant, 1.98e-9, 0.03, dt=float(time[1]), stop=float(time[-1]))
    assert step == pytest.approx(wanted.output[: step.size])
    assert axes[3].get_xlabel() == "Frequency (Hz)"


def test_a_loop_per_label_and_no_steps_of_an_unstable_one() -> None:
    plant = shaft_speed_plant()
    loops = {"fast": fastest_pi(plant, phase_margin=1.0), "far too much": known_pi(plant, 1.41e-5, 0.000159)}
    figure = tuning_figure(loops, dt=1e-3)
    assert [text.get_text() for text in figure.legends[0].get_texts()] == list(loops)
    assert len(figure.axes[2].lines) == 1


def test_nothing_to_draw_is_refused() -> None:
    with pytest.raises(BadInput, match="at least one loop"):
        tuning_figure({}, dt=1e-3)
