"""Text, data and page say what the approximation holds, and no more than it can know."""

import json
import re
from dataclasses import replace

import numpy as np

from pysim.identify.multisine import DropPeriods, fast_approximation, robust_approximation, smooth_approximation
from pysim.present import Drawing
from pysim.present.multisine import Approximations, data, page, text, verdicts
from pysim.types import BestLinearApproximation, Level
from tests.pysim.identify.multisine.systems import FULL, ODD, measure, with_free_lines

FREE = with_free_lines(ODD, seed=11)
SQUARE = fast_approximation(
    measure(FREE, realisations=1, periods=4, noise=0.01, seed=8, respond=lambda u: u + 0.1 * u**2),
    transient=DropPeriods(0),
)


def one(bla: BestLinearApproximation) -> Approximations:
    return Approximations("A title", (("bench", bla),))


def test_verdicts_name_what_is_there_and_what_is_not_seen() -> None:
    done, even, odd, _ = verdicts(SQUARE)
    assert re.findall(r"\d+", done)[:3] == ["1", "4", "2"]  # realisations, periods, their length
    assert " even is there (p < 1e-6)" in even
    assert " odd is not seen" in odd
    linear = verdicts(smooth_approximation(measure(FULL, realisations=1, periods=4, noise=0.01, seed=1), width=11))
    assert "is not seen" in linear[1]


def test_the_worst_line_is_one_that_stands_out() -> None:
    """A line of which little is known may look worst of all; it must not hide the others."""
    assert SQUARE.distortion is not None
    f, gain = SQUARE.frequency, np.full(SQUARE.frequency.size, 2.0)
    variance, low = np.full(f.size, 0.01), np.full(f.size, -0.01)
    variance[[3, 5, 8]], low[[5, 8]] = (4.0, 0.04, 0.02), 0.01
    found = replace(SQUARE, gain=gain, distortion=Level(f, variance, low, 2 * variance))
    assert verdicts(found)[-1] == f"Worst at {f[5]:g} Hz: distortion 20.0 dB below the linear response"  # 0.04 of 2^2
    none = replace(found, distortion=Level(f, variance, -variance, 2 * variance))
    assert verdicts(none)[-1] == "No single line's distortion stands out of its noise"


def test_a_linear_system_has_no_worst_line() -> None:
    by_chance = 0
    for seed in range(10):
        linear = fast_approximation(measure(FREE, realisations=1, periods=4, noise=0.01, seed=seed))
        assert linear.distortion is not None
        by_chance += bool(np.any(linear.distortion.low > 0))
        assert verdicts(linear)[-1] == "No single line's distortion stands out of its noise"
    assert by_chance > 0


def test_pressures_are_told_in_bar() -> None:
    test = replace(SQUARE.test, offset=1e7, rms=5e5, input_unit="Pa")
    assert "around 100 bar with 5 bar rms" in verdicts(replace(SQUARE, test=test))[0]


def test_text_has_a_row_per_frequency_and_a_dash_below_the_noise() -> None:
    lines = text(one(SQUARE)).splitlines()
    assert lines[6].split()[0] == "0.5"
    assert lines[6].split()[-1] == "-"
    assert float(lines[6].split()[1]) == round(20 * np.log10(abs(SQUARE.gain[0])), 2)


def test_where_noise_cannot_be_told_apart_the_table_shows_both_together() -> None:
    alone = robust_approximation(measure(FREE, realisations=3, periods=1, noise=0.01, seed=2))
    lines = text(one(alone)).splitlines()
    assert "noise + distortion dB  distortion dB" in lines[3]
    assert alone.total is not None
    assert lines[4].split()[5:] == [f"{10 * np.log10(alone.total.variance[0]):.1f}", "-", "-", "-"]


def test_data_is_complete_and_json() -> None:
    (again,) = json.loads(json.dumps(data(one(SQUARE)), allow_nan=False))["approximations"]
    np.testing.assert_allclose(np.array(again["gain_real"]) + 1j * np.array(again["gain_imag"]), SQUARE.gain)
    assert SQUARE.even is not None
    np.testing.assert_allclose(again["levels"]["even"]["variance"], SQUARE.even.variance)
    assert again["levels"]["even"]["p_value"] < 1e-6 < again["levels"]["odd"]["p_value"]
    assert again["test"]["input"] == "u"
    alone = robust_approximation(measure(FREE, realisations=3, periods=1, noise=0.1, seed=2))
    (single,) = data(one(alone))["approximations"]
    assert single["levels"]["noise"] is None


def test_page_holds_tables_pictures_and_the_command() -> None:
    html = page(one(SQUARE), [Drawing("multisine_1", "A caption", b"<svg/>")], "pysim multisine x")
    for words in ("A title", "bench, fast", "A caption", "pysim multisine x", "<table>"):
        assert words in html
