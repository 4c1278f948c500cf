"""The figures of a diagnosis show the numbers of the answer."""

from dataclasses import replace

import numpy as np
import pytest

from pysim.present.diagnosis.figures import (
    candidates_figure,
    error_figure,
    map_figure,
    overlay_figure,
    parameters_figure,
    spectrum_figure,
    telling_records,
)
from pysim.types import BadInput, Record, RecordFit
from tests.pysim.diagnosis_answer import WAVE, dataset, found_offset, nothing, step


def texts(axes: object) -> list[str]:
    return [text.get_text() for text in axes.texts]  # type: ignore[attr-defined]


def test_the_error_falls_and_marks_the_criteria() -> None:
    figure = error_figure(found_offset().history)
    top, low = figure.axes
    fitted, held = (line.get_ydata() for line in top.lines[1:])
    assert list(fitted) == [8.1, 4.2, 1.0]
    assert list(held) == [8.0, 3.2, 1.01]
    assert [label.get_text() for label in top.get_xticklabels()] == ["as it is", "refitted", "+ toy.offset"]
    assert texts(low) == ["0.9  ✗", "0.6  ✗", "0.1  ✓"]
    assert [label.get_text() for label in low.get_yticklabels()] == ["mean magnitude ≤ 0.5 dB"]


def test_the_error_of_logs_that_nobody_looked_at_is_drawn_too() -> None:
    steps = [replace(one, test=one.fit + 1) for one in found_offset().history if one.fit is not None]
    figure = error_figure(steps)
    assert list(figure.axes[0].lines[-1].get_ydata()) == pytest.approx([9.1, 5.2, 2.0])
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["fitted", "used to choose", "held out"]


def test_an_error_without_held_out_data_has_one_line() -> None:
    figure = error_figure([step("prior", 2.0, None, 0.1)])
    assert len([line for line in figure.axes[0].lines if len(line.get_xdata()) == 1]) == 1
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["fitted"]
    with pytest.raises(BadInput, match="at least one step"):
        error_figure([])


def test_candidates_stand_by_what_they_explain_refitted_and_screened_ones_apart() -> None:
    axes = candidates_figure(found_offset()).axes[0]
    best, twin, other, idle = axes.patches
    assert [bar.get_width() for bar in axes.patches] == pytest.approx([99.0, 98.0, 5.0, 0.0])
    assert best.get_facecolor() == twin.get_facecolor() != other.get_facecolor()
    assert (best.get_hatch(), other.get_hatch(), idle.get_hatch()) == (None, "////", "////")
    alone = candidates_figure(found_offset(ties=())).axes[0].patches
    assert alone[0].get_facecolor() != alone[1].get_facecolor()  # what was added, and what was not


def test_candidates_beside_an_effect_are_named_with_it() -> None:
    rows = found_offset().rivals
    again = tuple(replace(row, effects=("toy.offset", *row.effects), refitted=True) for row in rows[2:])
    axes = candidates_figure(found_offset(ties=(), rivals=(*again, *rows))).axes[0]
    names = [label.get_text() for label in axes.get_yticklabels()]
    assert names[:2] == ["toy.offset", "toy.twin"]
    assert names[4:] == ["toy.offset + toy.other"]  # the other one is no better for its parameters


def test_the_picture_of_candidates_needs_some() -> None:
    with pytest.raises(BadInput, match="candidate"):
        candidates_figure(found_offset(rivals=()))


def test_the_telling_records_are_the_worst_of_each_kind() -> None:
    assert [record.source for record in telling_records(found_offset())] == ["wave.txt", "sines/1Hz.txt", "held.txt"]


def test_an_overlay_shows_every_model_and_what_it_leaves() -> None:
    found = found_offset()
    figure = overlay_figure(found, found.history[1].records[1])
    top, low = figure.axes
    assert len(top.lines) == 4  # measured and three models
    assert top.lines[0].get_xdata()[0] == pytest.approx(8 - 0.01 - 2 / 5, abs=0.011)  # two periods
    assert top.get_ylabel() == "x (mm)"
    assert np.ptp(top.lines[-1].get_ydata()) == pytest.approx(40e3, rel=0.01)  # a wave of 20 m
    base, final = low.lines
    assert np.mean(base.get_ydata()) == pytest.approx(3.0, abs=0.3)
    assert np.mean(final.get_ydata()) == pytest.approx(0.0, abs=0.3)
    assert "toy.offset" in low.get_title(loc="left")
    less = nothing()
    assert len(overlay_figure(less, telling_records(less)[0]).axes[0].lines) == 3
    with pytest.raises(BadInput, match=r"wave\.txt"):
        overlay_figure(less, found.history[1].records[2])


def test_the_map_holds_the_residuals_by_test_and_frequency() -> None:
    figure = map_figure(found_offset(), dataset())
    before, after, logs, _, _ = figure.axes
    assert [label.get_text() for label in before.get_xticklabels()] == ["1", "5"]
    assert [label.get_text() for label in before.get_yticklabels()] == ["offset 50 N, amplitude 10 N"]
    assert texts(before) == ["4.6", "3.2"]  # the roots of 1 + 4.5^2 and 1 + 3^2
    assert texts(after) == ["1.0", "1.0"]
    assert [label.get_text() for label in logs.get_yticklabels()] == [
        "wave.txt (fitted): x",
        "held.txt (used to choose): x",
    ]
    bare = map_figure(found_offset(), None).axes[0]
    assert [label.get_text() for label in bare.get_yticklabels()] == ["sines/1Hz.txt", "sines/5Hz.txt"]
    with pytest.raises(BadInput, match="residual map"):
        map_figure(found_offset(history=()), dataset())


def test_of_a_test_that_was_repeated_the_map_shows_the_worst() -> None:
    told, data = found_offset(), dataset()
    stages = []
    for one in told.history:
        sines = [record for record in one.records if record.harmonics]
        again = [replace(r, index=4 + r.index, noise=tuple(n / 3 for n in r.noise)) for r in sines]
        stages.append(replace(one, records=(*one.records, *again)))
    repeated = tuple(replace(r, source=f"again/{r.source}") for r in data.records if r.frequency)
    both = replace(data, records=(*data.records, *repeated))
    before = map_figure(replace(told, history=tuple(stages)), both).axes[0]
    assert [label.get_text() for label in before.get_yticklabels()] == ["offset 50 N, amplitude 10 N"]
    assert [float(text) for text in texts(before)] == pytest.approx([3 * 4.6, 3 * 3.2], abs=0.2)


def test_the_map_tells_sines_of_one_file_apart() -> None:
    told, data = found_offset(), dataset()
    one_file = {record.source: "all.tdms" for record in data.records if record.frequency}
    records = [replace(r, source=one_file.get(r.source, r.source)) for r in data.records]
    records[1] = replace(records[1], offset=80.0)  # the one of 5 Hz
    stages = [
        replace(s, records=tuple(replace(r, source=one_file.get(r.source, r.source)) for r in s.records))
        for s in told.history
    ]
    before = map_figure(replace(told, history=tuple(stages)), replace(data, records=tuple(records))).axes[0]
    rows = [label.get_text() for label in before.get_yticklabels()]
    assert rows == ["offset 50 N, amplitude 10 N", "offset 80 N, amplitude 10 N"]
    values = np.asarray(before.images[0].get_array())
    assert values[0, 0] == pytest.approx(4.6, abs=0.1)
    assert values[1, 1] == pytest.approx(3.2, abs=0.1)


def doubled(record: RecordFit) -> RecordFit:
    """The same record with a second signal beside it."""
    sides = [
        Record(one.time, np.column_stack([one.values, 3 * one.values]), ("x", "y"), ("m", "m"))
        for one in (record.measured, record.simulated)
    ]
    return replace(record, measured=sides[0], simulated=sides[1], noise=record.noise * 2)


def test_logs_of_one_file_stand_beside_themselves() -> None:
    """The one that is held out has a signal more."""
    told = found_offset()
    stages = []
    for one in told.history:
        log, held = (replace(record, source="all.tdms") for record in one.records[2:])
        stages.append(replace(one, records=(*one.records[:2], log, doubled(held))))
    told = replace(told, history=tuple(stages))
    held = telling_records(told)[2]
    assert (held.source, held.measured.names) == ("all.tdms", ("x", "y"))
    figure = overlay_figure(told, held)
    assert [len(axes.lines) for axes in figure.axes] == [4, 4, 4, 4]  # of two models dots and means
    assert len([axes for axes in spectrum_figure(told).axes if axes.lines]) == 3


def test_parameters_show_which_were_biased_once_the_scale_is_the_same() -> None:
    found = found_offset()
    figure = parameters_figure(found.history[1], found.history[2])
    left, right = figure.axes
    assert texts(right) == ["held, sets the scale", "0.0", "2.2"]  # k went from 3 to 0.75 as m from 2 to 1; d by 0.5
    assert [label.get_text() for label in left.get_yticklabels()] == ["m (N)", "k (N)", "d (N)"]
    assert len(parameters_figure(found.history[1], None).axes) == 1
    with pytest.raises(BadInput, match="no estimates"):
        parameters_figure(found.history[0], None)


def test_the_spectrum_of_noise_is_one_and_a_ripple_stands_out() -> None:
    figure = spectrum_figure(found_offset())
    assert [axes.get_title(loc="left") for axes in figure.axes] == ["wave.txt: x", "held.txt: x"]
    _, rippled, flat = figure.axes[0].lines
    assert np.mean(flat.get_ydata()) == pytest.approx(1.0, abs=0.15)
    frequency, power = rippled.get_xdata(), rippled.get_ydata()
    assert frequency[np.argmax(np.where(frequency > 3, power, 0))] == pytest.approx(WAVE, abs=1.0)
    with pytest.raises(BadInput, match="spectrum"):
        spectrum_figure(found_offset(history=()))
