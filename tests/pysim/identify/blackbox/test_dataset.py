"""Responses of a data set, from tables and from logs."""

import numpy as np
import pytest

from pysim.identify.blackbox import Structure, fit_dataset
from pysim.types import BadInput
from tests.pysim.identify.blackbox.logs import SYSTEM, F, dataset, log, table


def test_tables_and_their_deviations() -> None:
    seen = []
    fitted = fit_dataset(
        dataset(table(0, 1), table(5, 1)), Structure(2), progress=lambda done, total: seen.append((done, total))
    )
    assert [one.label for one in fitted] == ["O+0 A1", "O+5 A1"]
    assert seen == [(1, 2), (2, 2)]
    np.testing.assert_allclose(fitted[0].fit.function.denominator, SYSTEM.denominator, rtol=1e-8)
    assert fitted[0].reference_hz == 0.1
    assert max(d.value for d in fitted[0].deviations) < 1e-6
    poor = fit_dataset(dataset(table(0, 1)), Structure(1))[0]
    assert poor.deviations[3].value > 5


def test_logs_with_their_noise() -> None:
    (one,) = fit_dataset(dataset(*(log(f, i) for i, f in enumerate(F))), Structure(2))
    assert one.fit.noise_known
    truth = [*SYSTEM.numerator, *SYSTEM.denominator[1:]]
    for estimate, value in zip(one.fit.estimates(0.999), truth, strict=True):
        assert estimate.interval[0] < value < estimate.interval[1]
        assert estimate.std < 0.01 * abs(value)


def test_some_tests_only_and_orders_on_request() -> None:
    data = dataset(table(0, 1), table(5, 1), table(5, 2))
    (one,) = fit_dataset(data, Structure(3), suggest=True, tests=[(5.0, 2.0)])
    assert one.suggestion is not None
    assert one.fit is one.suggestion.suggested.fit
    assert (one.fit.structure.poles, one.fit.structure.zeros) == (2, 0)
    with pytest.raises(BadInput, match="no test 7/1; it has 0/1, 5/1, 5/2"):
        fit_dataset(data, Structure(2), tests=[(7.0, 1.0)])


def test_refuses_a_data_set_without_responses() -> None:
    with pytest.raises(BadInput, match="no frequency response"):
        fit_dataset(dataset(), Structure(2))
