"""The map of the error."""

from pysim.present.charts import plain
from pysim.present.diagnosis.figures.where import map_chart


def test_a_map_writes_its_numbers_into_the_cells_and_names_as_they_are() -> None:
    found = map_chart(["<b>"], ["1 Hz", "2 Hz"], [[1.234, None]], "title")
    assert plain("<b>") in str(found)
    assert "1.2" in str(found["data"])
