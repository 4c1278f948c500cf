import json
import math

import numpy as np
import pytest

from pysim.control.tuning import (
    Plant,
    fastest_pi,
    known_pi,
    load_pressure_plant,
    loop_response,
    shaft_speed_plant,
    tune_pi,
)
from pysim.control.tuning.margins import open_loop
from pysim.present import Drawing
from pysim.present.tuning import Tuning, data, page, text, tuning_figure
from pysim.types import BadInput

LOOPS = {
    "MATLAB": known_pi(load_pressure_plant(), 1.01e-9, 0.023),
    "wild": known_pi(shaft_speed_plant(), 1.41e-5, 0.000159),
}


def test_text_tells_gains_margins_and_stability() -> None:
    head, first, second, warning = text(Tuning(LOOPS, 1e-3)).splitlines()
    assert head.split()[:1] == ["K_p"]
    assert {"1.01e-09", "0.023", "3.018", "60.06", "35.5", "yes"} <= set(first.split())
    assert second.endswith("NO")
    assert "wild" in warning


def test_data_in_hertz_and_degrees() -> None:
    found = json.loads(json.dumps(data(Tuning(LOOPS, 1e-3)), allow_nan=False))
    assert found["MATLAB"]["phase_margin_deg"] == pytest.approx(60.06, abs=0.01)
    assert found["MATLAB"]["crossover_hz"] == pytest.approx(18.96 / (2 * math.pi), rel=1e-3)
    assert found["wild"]["stable"] is False


def test_page_holds_table_picture_and_the_way_back() -> None:
    html = page(Tuning(LOOPS, 1e-3), [Drawing("tuning", "A caption.", b"<svg/>")], "pysim tune load")
    for part in ("A caption.", "60.06", "pysim tune load"):
        assert part in html


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
    parts = round(1e-3 / float(time[1]))
    wanted = loop_response(gains.plant, 1.98e-9, 0.03, dt=1e-3, stop=float(time[-1]), parts=parts)
    assert step == pytest.approx(wanted.output[: step.size])
    assert axes[3].get_xlabel() == "Frequency (Hz)"


def test_a_loop_per_label_and_no_steps_of_an_unstable_one() -> None:
    plant = shaft_speed_plant()
    loops = {"fast": fastest_pi(plant, phase_margin=1.0), "far too much": known_pi(plant, 1.41e-5, 0.000159)}
    figure = tuning_figure(loops, dt=1e-3)
    assert [text.get_text() for text in figure.legends[0].get_texts()] == list(loops)
    assert len(figure.axes[2].lines) == 1


def test_frequencies_reach_beyond_the_fastest_crossover() -> None:
    plant = Plant((1.0,), (0.1, 1.0))
    loops = {"slow": known_pi(plant, 0.1, 0.1), "fast": known_pi(plant, 100.0, 0.1)}
    hertz = np.asarray(tuning_figure(loops, dt=1e-2).axes[0].lines[0].get_xdata())
    crossovers = [gains.loop.crossover / (2 * math.pi) for gains in loops.values()]
    assert hertz[0] <= min(crossovers) / 49
    assert hertz[-1] >= 49 * max(crossovers)


def test_steps_are_those_of_the_controller_as_it_is_sampled() -> None:
    """5 Hz on a lag of 0.1 s, sampled at 20 Hz: the loop goes off."""
    gains = tune_pi(Plant((1.0,), (0.1, 1.0)), crossover=10 * math.pi, phase_margin=math.radians(60))
    axes = tuning_figure({"tuned": gains}, dt=0.05).axes
    time, step = (np.asarray(x) for x in axes[2].lines[0].get_data())
    assert time[-1] > 10 * 0.05
    assert np.isin(np.round(np.arange(10) * 0.05, 9), np.round(time, 9)).all()
    assert 2.5 < np.abs(step).max() <= 4.0  # drawn as far as it stays in the picture
    assert [text.get_text() for text in axes[2].texts] == ["goes off"]
    assert np.abs(np.asarray(axes[5].lines[0].get_ydata())).max() < 10.0
    calm = tuning_figure({"tuned": gains}, dt=1e-3).axes[2]
    assert not calm.texts
    assert np.asarray(calm.lines[0].get_ydata())[-1] == pytest.approx(1.0, abs=0.05)


@pytest.mark.parametrize("dt", [0.05, 1.0, 50.0])
def test_a_loop_far_too_fast_for_its_sampling_is_drawn_readably(dt: float) -> None:
    gains = known_pi(Plant((1.0,), (0.1, 1.0)), 100.0, 0.1)
    axes = tuning_figure({"wild": gains, "calm": known_pi(gains.plant, 1e-3 / dt, 0.1)}, dt=dt).axes
    assert [text.get_text() for text in axes[2].texts] == ["goes off"]
    low, high = axes[2].get_ylim()
    assert -5 < low < high < 5


def test_a_slow_loop_beside_a_fast_one_is_drawn_until_it_rests_in_so_many_steps_as_can_be_waited_for() -> None:
    """5 Hz and 1 uHz on a lag of 0.1 s: at 1 ms the slow one takes a thousand million steps."""
    plant = Plant((1.0,), (0.1, 1.0))
    loops = {f"{hz} Hz": known_pi(plant, 0.2 * math.pi * hz, 0.1) for hz in (5.0, 1e-6)}
    for line, whole in zip(tuning_figure(loops, dt=1e-3).axes[2].lines, (False, True), strict=True):
        time, step = (np.asarray(x) for x in line.get_data())
        assert time.size < 200_000
        assert (time[-1] > 1e6) == whole
        assert step[-1] == pytest.approx(1.0, abs=0.01)


def test_nothing_to_draw_is_refused() -> None:
    with pytest.raises(BadInput, match="at least one loop"):
        tuning_figure({}, dt=1e-3)
