from pathlib import Path

import numpy as np
import pytest

from pysim.io import read_signal
from pysim.types import BadInput


def test_samples_are_joined_by_straight_lines(tmp_path: Path) -> None:
    (tmp_path / "u.csv").write_text("time [s];u [%]\n0;1,5\n2;2,5\n")
    signal = read_signal(tmp_path / "u.csv", "--input u")
    np.testing.assert_allclose(signal.value(np.array([-1, 0, 1, 2, 3])), [1.5, 1.5, 2.0, 2.5, 2.5])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("time,u\n0,1\n1,2\n\n1,3\n", r"u\.csv, line 5: time 1 s does not increase"),
        ("0,1\n", "holds a single row"),
        ("0,1\n1,x\n", "line 2: 'x' is no number for value"),
        ("0,1\n1,nan\n", "line 2: value is nan"),
    ],
)
def test_what_is_no_signal_is_refused_with_its_line(tmp_path: Path, text: str, words: str) -> None:
    (tmp_path / "u.csv").write_text(text)
    with pytest.raises(BadInput, match=words):
        read_signal(tmp_path / "u.csv", "--input u")
