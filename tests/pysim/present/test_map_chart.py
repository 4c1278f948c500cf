"""The map of the error."""

from pysim.present.charts import plain
from pysim.present.diagnosis.figures.where import map_chart, map_words
from pysim.types import Dataset, MeasuredSignal


def test_a_map_writes_its_numbers_into_the_cells_and_names_as_they_are() -> None:
    found = map_chart(["<b>"], ["1 Hz", "2 Hz"], [[1.234, None]], "title")
    assert plain("<b>") in str(found)
    assert "1.2" in str(found["data"])


def test_a_map_says_where_its_noise_is_from_only_where_it_was_not_specified() -> None:
    known, unknown = (MeasuredSignal("x", "output", "m", "", "x", noise) for noise in (1e-3, None))
    assert map_words(Dataset("d", "", "", (known,), ())).endswith("Click a cell to open its record.")
    assert "how large the noise is" in map_words(Dataset("d", "", "", (unknown,), ()))
