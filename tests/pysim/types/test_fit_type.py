import math
from dataclasses import replace

import numpy as np
import pytest

from pysim.types import BadInput, Record
from tests.pysim.fits import small_fit


def test_residuals_are_counted_in_noise() -> None:
    record = small_fit().records[0]
    assert record.rms == pytest.approx({"y": 2.0, "u": 0.0})
    assert record.residual["y"] == pytest.approx(np.full(50, -2.0))


def test_held_out_records_are_listed_by_signal() -> None:
    assert small_fit().held_out() == pytest.approx({"wave.txt: y": 2.0, "wave.txt: u": 0.0})


def test_what_is_not_determined_has_no_correlation() -> None:
    fit = small_fit()
    assert [e.determined for e in fit.estimates] == [True, False, True]
    assert fit.correlation[0, 0] == pytest.approx(1.0)
    assert math.isnan(fit.correlation[0, 1])


def test_a_fit_does_not_change_and_knows_its_names() -> None:
    fit = small_fit()
    with pytest.raises(ValueError, match="read-only"):
        fit.covariance[0, 0] = 1.0
    assert fit["T"].at == "lower"
    with pytest.raises(BadInput, match="'tau' was not free; free were K, g, T"):
        fit["tau"]
    with pytest.raises(BadInput, match="covariance of shape"):
        replace(fit, covariance=np.zeros((2, 2)))


def test_records_that_do_not_match_are_refused() -> None:
    record = small_fit().records[0]
    other = Record(record.measured.time, record.measured.values[:, :1], ("y",), ("%",))
    with pytest.raises(BadInput, match="same columns"):
        replace(record, simulated=other)
