"""The map of the error."""

from pysim.present.interactive import map_figure, plain


def test_a_map_writes_its_numbers_into_the_cells_and_names_as_they_are() -> None:
    found = map_figure(["<b>"], ["1 Hz", "2 Hz"], [[1.234, None]], "title")
    assert plain("<b>") in str(found)
    assert "1.2" in str(found["data"])
