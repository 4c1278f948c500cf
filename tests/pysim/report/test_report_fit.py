import json

from pysim.report.fit import fit_data, fit_page, fit_text
from tests.pysim.fits import small_fit


def test_the_text_has_the_numbers_of_the_fit() -> None:
    text = fit_text(small_fit())
    assert "K g = 2, 95 % 1.9 to 2.1" in text
    for record in ("wave.txt", "2 stepped sines"):
        line = next(line for line in text.splitlines() if record in line)
        assert "2.000" in line
    assert all(note in text for note in small_fit().notes)


def test_the_data_are_plain_and_finite() -> None:
    data = fit_data(small_fit())
    json.dumps(data, allow_nan=False)
    assert data["estimates"]["K"]["interval"] == [1.8, 2.2]
    assert data["estimates"]["g"] | {} == {
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
    assert data["records"][0]["criteria"]["y"]["E_t mean"] == {"value": 0.2, "limit": 2.0}


def test_the_page_holds_everything_a_reader_needs() -> None:
    page = fit_page(small_fit(), units={"w": "rad"}, pictures=[("A picture", b"<svg/>")], redo="pysim fit")
    for text in ("K g", "wave.txt", "A picture", "pysim fit", "1432.39 deg"):
        assert text in page
