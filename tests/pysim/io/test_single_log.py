from pathlib import Path

import numpy as np
import pytest

from pysim.io import read_single_log
from pysim.types import BadInput

TEXT = "t\tcmd\tangle\n0.0\t1\t2\n0.1\t2\t4\n"


def test_a_log_becomes_a_data_set_in_si_units(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text(TEXT)
    dataset = read_single_log(tmp_path / "a.txt", "chirp", ("time", "u", "y"), ("%", "deg"))
    assert [(s.name, s.role, s.unit) for s in dataset.signals] == [("u", "input", "%"), ("y", "output", "rad")]
    (record,) = dataset.records
    assert (record.kind, record.source) == ("chirp", "a.txt")
    np.testing.assert_allclose(record.data["y"], np.radians([2.0, 4.0]))  # type: ignore[index]
    np.testing.assert_allclose(record.data.time, [0.0, 0.1])  # type: ignore[union-attr]


@pytest.mark.parametrize(
    ("columns", "units", "words"),
    [
        (("time", "u"), ("%",), "at least one response"),
        (("u", "time", "y"), ("%", "%"), "name time, the command"),
        (("time", "u", "y"), ("%",), "give one for u, y each"),
        (("time", "u", "y"), ("%", "furlong"), "the unit 'furlong' is not known; use one of 1, %"),
        (("time", "u", "y", "z"), ("%", "%", "%"), "line 2: 3 columns where 4 belong"),
    ],
)
def test_refuses_what_does_not_fit(tmp_path: Path, columns: tuple, units: tuple, words: str) -> None:
    (tmp_path / "a.txt").write_text(TEXT)
    with pytest.raises(BadInput, match=words):
        read_single_log(tmp_path / "a.txt", "chirp", columns, units)


def test_time_must_increase(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("0 1 2\n0 1 2\n")
    with pytest.raises(BadInput, match="line 2"):
        read_single_log(tmp_path / "a.txt", "chirp", ("time", "u", "y"), ("%", "%"))
