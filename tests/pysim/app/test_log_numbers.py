"""Records of a file of stages find their logs."""

from dataclasses import replace
from pathlib import Path

from pysim.app.log_numbers import log_numbers
from pysim.io import read_stages, write_stages
from tests.pysim.diagnosis_story import dataset, story


def test_records_of_a_file_are_told_by_what_stands_in_it(tmp_path: Path) -> None:
    write_stages(tmp_path / "a.npz", story().stages)
    for one in read_stages(tmp_path / "a.npz").about:
        assert log_numbers(one, dataset()) == (0, 1, 2, 3)
        assert log_numbers(one, replace(dataset(), records=dataset().records[::-1])) == (3, 2, 1, 0)
