"""Eq. 4.1 in the printed units of Table 4.1."""

import pytest

from pysim.identify import TransferFunction
from pysim.identify.blackbox import from_thesis_row, thesis_row
from pysim.types import BadInput

ROW = {"b0": 63158.0, "a4": 216.0, "a3": 89266.0, "a2": 12047.0, "a1": 1426.0, "a0": 61788.0}  # -75 percent, 5 percent


def test_there_and_back() -> None:
    function = from_thesis_row(ROW)
    assert function.gain == pytest.approx(63158 / 61788)
    assert function.denominator == (1.0, 216.0, 89266.0, 12047e3, 1426e6, 61788e6)
    assert thesis_row(function) == pytest.approx(ROW)
    doubled = TransferFunction(tuple(2 * b for b in function.numerator), tuple(2 * a for a in function.denominator))
    assert thesis_row(doubled) == pytest.approx(ROW)


def test_refuses_other_structures() -> None:
    with pytest.raises(BadInput, match="five poles"):
        thesis_row(TransferFunction((1.0,), (1.0, 1.0)))
