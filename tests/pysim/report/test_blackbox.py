"""Text, data and page hold the numbers of the fit."""

import json

import numpy as np
import pytest

from pysim.identify.blackbox import Structure, fit_dataset
from pysim.report.blackbox import blackbox_data, blackbox_page, blackbox_text
from tests.pysim.identify.blackbox.logs import F, dataset, log, table


@pytest.fixture(scope="module")
def fitted():
    return fit_dataset(dataset(*(log(f, i) for i, f in enumerate(F))), Structure(2))


def test_text(fitted) -> None:
    text = blackbox_text(fitted)
    assert text.startswith("O+20 A5: 2 poles, no zeros\n  fit 99.9")
    assert "degrees of freedom" in text
    pole = next(line for line in text.splitlines() if line.startswith("  pole"))
    assert float(pole.split()[1]) == pytest.approx(np.hypot(9, 30) / (2 * np.pi), rel=0.01)
    assert pole.endswith("(pair)")
    assert "note:" not in text


def test_data_is_plain_and_complete(fitted) -> None:
    (one,) = json.loads(json.dumps(blackbox_data(fitted, dataset="bench"), allow_nan=False))["responses"]
    assert one["denominator"] == pytest.approx([1.0, 18.0, 981.0], rel=0.01)
    value, (low, high) = (one["estimates"]["a0"][key] for key in ("value", "interval"))
    assert low < value < high
    assert value == one["denominator"][2]
    assert np.sqrt(one["covariance"]["matrix"][2][2]) == pytest.approx(one["estimates"]["a0"]["std"])
    assert len(one["residuals_standard_deviations"]) == len(F)
    assert one["structures"] is None


def test_what_is_not_determined_is_null() -> None:
    (one,) = blackbox_data(fit_dataset(dataset(table(0, 1)), Structure(3, 1)), dataset="bench")["responses"]
    assert one["estimates"]["a0"]["interval"] == [None, None]
    assert json.dumps(one, allow_nan=False)


def test_page_and_suggested_structures() -> None:
    one = fit_dataset(dataset(table(0, 1)), Structure(3), suggest=True)
    html = blackbox_page("bench <1>", one, pictures=[b"<svg/>"], redo="pysim blackbox x --poles 3")
    assert "bench &lt;1&gt;" in html
    assert "Structures that were compared" in html
    assert '<td class="differs">2 poles, no zeros</td>' in html
    assert html.count("<figure>") == 1
    assert "pysim blackbox x --poles 3" in html
    assert "2 poles, no zeros" in blackbox_text(one)
    assert "<- suggested" in blackbox_text(one)


def test_every_result_tells_its_signals() -> None:
    both = fit_dataset(dataset(table(25, 5), table(25, 5, output="p")), Structure(2))
    data = blackbox_data(both, dataset="bench")["responses"]
    assert [(one["output"], one["input"], one["origin"]) for one in data] == [(y, "u", "a table") for y in "yp"]
    html = blackbox_page("bench", both, pictures=[b"<svg/>"] * 2, redo="-")
    for name in ("O+25 A5, y to u", "O+25 A5, p to u"):
        assert f"{name}: 2 poles" in blackbox_text(both)
        assert f"{name}: 2 poles" in html  # the heading
        assert f"{name}: gain" in html  # the caption
