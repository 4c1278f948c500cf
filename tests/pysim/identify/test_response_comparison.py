"""`compare_responses` with a linear system in place of the FMU: every number is known in closed form."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from importlib import import_module
from typing import Any

import numpy as np
import pytest

from pysim.identify import compare_responses
from pysim.simulate import Rk4
from pysim.types import BadInput, Experiment, MeasuredRecord, Record
from tests.pysim import comparisons as linear


@pytest.fixture
def runs(monkeypatch: pytest.MonkeyPatch) -> list[Experiment]:
    """The experiments that were run."""
    seen: list[Experiment] = []
    _replace(monkeypatch, lambda experiment: seen.append(experiment) or linear.steady_output(experiment))
    return seen


def _replace(monkeypatch: pytest.MonkeyPatch, answer: Callable[[Experiment], Record]) -> None:
    def simulate_many(_: Any, experiments: Sequence[Experiment], *, progress: Any, **__: Any) -> list[Record]:
        records = [answer(experiment) for experiment in experiments]
        if progress is not None:
            progress(len(records), len(records))
        return records

    monkeypatch.setattr(import_module("pysim.identify.response_comparison"), "simulate_many", simulate_many)


def test_the_true_system_passes_with_no_deviation(runs: list[Experiment]) -> None:
    told: list[tuple[int, int]] = []
    result = compare_responses(linear.model(), linear.dataset(), label="true", progress=lambda *n: told.append(n))
    assert result.passes
    assert len(result.tests) == 4
    assert told[-1] == (16, 16) == (len(runs), len(runs))
    for test in result.tests:
        np.testing.assert_allclose([d.value for d in test.deviations], 0.0, atol=1e-9)
    assert (result.label, result.model, result.note) == ("true", "Linear", "Take it <with> care.")


def test_equal_measurements_count_once(runs: list[Experiment]) -> None:
    assert (
        compare_responses(linear.model(), linear.dataset()).independent == 1
    )  # a linear system answers alike everywhere


def test_overrides_reach_the_runs_and_change_the_verdict(runs: list[Experiment]) -> None:
    result = compare_responses(linear.model(), linear.dataset(), overrides={"k": 0.02})
    assert all(dict(experiment.overrides) == {"k": 0.02} for experiment in runs)
    gain = 1 + 0.02 * 2 * np.pi * np.array(linear.FREQUENCIES)
    expected = 20 * np.log10(gain / gain[0])
    values = [deviation.value for deviation in result.tests[0].deviations]
    np.testing.assert_allclose(values, [expected.mean(), expected.max(), 0.0, 0.0], atol=1e-9)
    assert not result.passes


def test_the_rate_is_fed_where_the_model_asks_for_it(runs: list[Experiment]) -> None:
    compare_responses(linear.model(linear.variable("cmd_t", "input", "%/s")), linear.dataset())
    assert dict(runs[0].rates) == {"cmd_t": "cmd"}
    runs.clear()
    compare_responses(linear.model(linear.variable("cmd_t", "local", "%/s")), linear.dataset())
    assert not runs[0].rates


def test_a_failed_run_fails_its_test_and_no_other(monkeypatch: pytest.MonkeyPatch) -> None:
    def answer(experiment: Experiment) -> Record:
        amplitude, _, omega, _ = experiment.inputs["cmd"].sines[-1, 0]
        fails = amplitude == 20.0 and omega > 60.0 and experiment.inputs["cmd"].cubics[-1, 0] > 0
        return linear.failed_output(experiment) if fails else linear.steady_output(experiment)

    _replace(monkeypatch, answer)
    result = compare_responses(linear.model(), linear.dataset())
    assert [test.passes for test in result.tests] == [True, True, True, False]
    assert result.tests[3].message == "at 12 Hz: a value is no longer finite. at t = 0.7 s"
    assert result.tests[3].simulated is None
    assert not result.passes


def test_an_output_that_stands_still_fails_its_test_and_no_other(monkeypatch: pytest.MonkeyPatch) -> None:
    def answer(experiment: Experiment) -> Record:
        record = linear.steady_output(experiment)
        still = experiment.inputs["cmd"].cubics[-1, 0] < 0 and experiment.inputs["cmd"].sines[-1, 0, 0] == 5.0
        return replace(record, values=np.full_like(record.values, 3.0)) if still else record

    _replace(monkeypatch, answer)
    result = compare_responses(linear.model(), linear.dataset())
    assert [test.passes for test in result.tests] == [False, True, True, True]
    assert result.tests[0].message == "at 0.1 Hz: angle does not move; there is no response to compare"


def test_the_reference_frequency_is_the_callers(runs: list[Experiment]) -> None:
    gain = 1 + 0.02 * 2 * np.pi * np.array(linear.FREQUENCIES)
    for reference_hz, at_zero in ((None, 1.0), (1.0, gain[1])):
        result = compare_responses(linear.model(), linear.dataset(), overrides={"k": 0.02}, reference_hz=reference_hz)
        expected = np.abs(20 * np.log10(gain / at_zero))
        values = [deviation.value for deviation in result.tests[0].deviations]
        np.testing.assert_allclose(values, [expected.mean(), expected.max(), 0.0, 0.0], atol=1e-9)
        assert result.reference_hz == reference_hz


def test_the_result_holds_what_it_takes_to_repeat_it(runs: list[Experiment]) -> None:
    result = compare_responses(
        linear.model(), linear.dataset(), overrides={"k": 0.5}, about="Table 9", solver=Rk4(step=1e-3)
    )
    assert dict(result.parameters) == {"k": (0.5, "1")}
    assert result.conditions["parameter set"] == "Table 9"
    assert result.conditions["FMU"] == "linear.fmu, FMI 2, identifier 0"
    assert result.conditions["solver"] == repr(Rk4(step=1e-3))
    assert result.conditions["fit"] == "1 whole periods of 24 points"
    assert "0.5 s of the sine" in result.conditions["settling"]
    again = compare_responses(
        linear.model(), linear.dataset(), overrides={"k": 0.5}, about="Table 9", solver=Rk4(step=1e-3)
    )
    assert dict(again.conditions) == dict(result.conditions)


def test_what_is_not_compared_stands_in_the_note(runs: list[Experiment]) -> None:
    data = linear.dataset()
    log = Record(np.arange(2.0), np.zeros((2, 2)), ("cmd", "angle"), ("%", "%"))
    logs = tuple(MeasuredRecord(f"{i}.txt", "other", "fit", log) for i in range(4))
    data = replace(data, records=logs + data.records)
    assert compare_responses(linear.model(), data).note.endswith(
        "Not compared: 4 logs over time (0.txt, 1.txt, 2.txt, ...)."
    )
    with pytest.raises(BadInput, match=r"no frequency responses \(4 logs over time\)"):
        compare_responses(linear.model(), replace(data, records=logs))


def test_a_missing_reference_frequency_is_known_before_the_first_run(runs: list[Experiment]) -> None:
    with pytest.raises(BadInput, match=r"relative to 0\.7 Hz need that frequency"):
        compare_responses(linear.model(), linear.dataset(), reference_hz=0.7)
    assert not runs


@pytest.mark.parametrize(
    ("model", "responses", "words"),
    [
        (linear.model(), [], "holds no frequency responses"),
        (linear.model(unit="rad"), None, "'cmd' of data set 'bench' is in '%', cmd of linear.fmu in 'rad'"),
    ],
)
def test_refuses_what_cannot_be_compared(model: Any, responses: Any, words: str, runs: list[Experiment]) -> None:
    with pytest.raises(BadInput, match=words):
        compare_responses(model, linear.dataset(responses))
    assert not runs
