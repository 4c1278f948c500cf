import json
import tomllib
from dataclasses import replace

import numpy as np

from pysim.present import Drawing
from pysim.present.fit import Fitted, data, files, page, text
from pysim.types import Dataset, MeasuredSignal
from tests.pysim.fits import small_fit


def test_the_text_has_the_numbers_of_the_fit() -> None:
    told = text(Fitted(small_fit(), ()))
    assert "K g = 2, 95 % 1.9 to 2.1" in told
    for record in ("wave.txt", "2 stepped sines"):
        line = next(line for line in told.splitlines() if record in line)
        assert "2.000" in line
    assert "set: no noise is specified for u" in " ".join(told.split())


def test_the_data_are_plain_and_finite() -> None:
    found = data(Fitted(small_fit(), ()))
    json.dumps(found, allow_nan=False)
    assert found["estimates"]["K"]["interval"] == [1.8, 2.2]
    assert found["estimates"]["g"] | {} == {
        "value": 1.0,
        "unit": "1",
        "start": 1.0,
        "lower": 0.1,
        "upper": None,
        "std": None,
        "interval": [0.1, None],
        "at_bound": "",
        "determined": False,
    }
    assert found["records"][0]["criteria"]["y"]["E_t mean"] == {"value": 0.2, "limit": 2.0}


def test_samples_are_those_that_were_measured() -> None:
    fit = small_fit()
    (one, *_) = fit.records
    values = one.measured.values.copy()
    values[[0, 2], 0] = np.nan
    lacking = replace(one, measured=replace(one.measured, values=values))
    found = data(Fitted(replace(fit, records=(lacking,)), ()))
    assert next(iter(found["records"][0]["samples"].values())) == one.measured.time.size - 2


def test_the_page_holds_everything_a_reader_needs() -> None:
    signals = (MeasuredSignal("w", "input", "rad", "", "w"),)
    result = Fitted(small_fit(), (Dataset("set", "-", "-", signals, ()),))
    html = page(result, [Drawing("a", "A picture", b"<svg/>")], "pysim fit")
    for word in ("K g", "wave.txt", "A picture", "pysim fit", "1432.39 deg"):
        assert word in html


def test_the_values_can_be_read_again() -> None:
    (content,) = files(Fitted(small_fit(), ())).values()
    assert tomllib.loads(content) == {name: value for name, value in small_fit().values.items() if "@" not in name}
