"""Responses of a data set, from tables and from logs."""

from dataclasses import replace

import numpy as np
import pytest

from pysim.identify.blackbox import Structure, fit_dataset
from pysim.types import BadInput, FrequencyResponse, MeasuredRecord
from tests.pysim.identify.blackbox.logs import SIGNALS, SYSTEM, F, dataset, log, table


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


def test_what_is_held_out_is_not_fitted_but_compared() -> None:
    fitted = [log(f, i) for i, f in enumerate(F)]
    held_out = [log(f, i, "validate", gain=1.1) for i, f in enumerate(F[1:4])]
    (alone,) = fit_dataset(dataset(*fitted), Structure(2))
    (one,) = fit_dataset(dataset(*held_out, *fitted), Structure(2))
    assert alone.held_out == ()
    np.testing.assert_array_equal(one.fit.function.denominator, alone.fit.function.denominator)
    (deviations,) = one.held_out  # without 0.1 Hz: absolute
    assert deviations[0].value == pytest.approx(20 * np.log10(1.1), rel=0.02)
    exact = fit_dataset(dataset(table(0, 1), table(0, 1, "validate"), table(5, 1, "validate")), Structure(2))
    assert [len(one.held_out) for one in exact] == [1]
    with pytest.raises(BadInput, match="none of its responses is to be fitted"):
        fit_dataset(dataset(table(0, 1, "validate")), Structure(2))


def sevenfold(record: MeasuredRecord) -> MeasuredRecord:
    """The same table with a larger answer."""
    assert isinstance(record.data, FrequencyResponse)
    return replace(record, data=replace(record.data, gain=7 * record.data.gain))


def test_outputs_are_kept_apart() -> None:
    data = dataset(*(table(0, 1, use, output) for output in ("y", "p") for use in ("fit", "validate")))
    data = replace(data, records=tuple(sevenfold(one) if one.data.test.output == "p" else one for one in data.records))
    both = fit_dataset(data, Structure(2))
    assert [one.measured.test.output for one in both] == ["y", "p"]
    for one in both:
        (deviations,) = one.held_out
        assert max(d.value for d in deviations) < 1e-6
    (alone,) = fit_dataset(data, Structure(2), output="p")
    assert alone.measured.test.output == "p"
    with pytest.raises(BadInput, match="holds no frequency response of q"):
        fit_dataset(data, Structure(2), output="q")


def test_a_label_names_the_signals_where_there_are_several() -> None:
    tables = dataset(table(0, 1), table(0, 1, output="p"), table(5, 1, "validate"))
    assert [one.label for one in fit_dataset(tables, Structure(2))] == ["O+0 A1, y to u", "O+0 A1, p to u"]
    logs = dataset(*(log(f, i, output=output) for output in ("y", "p") for i, f in enumerate(F)))
    assert [one.label for one in fit_dataset(logs, Structure(2))] == ["O+20 A5, y to u", "O+20 A5, p to u"]
    assert [one.label for one in fit_dataset(tables, Structure(2), output="p")] == ["O+0 A1"]


def test_tests_are_named_in_the_unit_that_people_read() -> None:
    bar = replace(SIGNALS[0], unit="Pa")
    data = replace(dataset(table(100e5, 10e5), table(50e5, 10e5)), signals=(bar, SIGNALS[1]))
    (one,) = fit_dataset(data, Structure(2), tests=[(100.0, 10.0)])
    assert one.label == "O+100 A10"
    assert one.measured.test.offset == 100e5
    with pytest.raises(BadInput, match="no test 7/1; it has 100/10, 50/10"):
        fit_dataset(data, Structure(2), tests=[(7.0, 1.0)])


def test_refuses_a_data_set_without_responses() -> None:
    with pytest.raises(BadInput, match="no frequency response"):
        fit_dataset(dataset(), Structure(2))
