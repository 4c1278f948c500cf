"""Which models run by themselves, and that each has its stored result."""

import numpy as np
import pytest

from tests.modelica.library import models_in
from validation.examples import stored
from validation.examples.catalogue import LIMITS, REFUSED, RESULTS, ROWS, WIDEST, Example, Limit, examples, libraries_of

EXAMPLES = examples()


def test_all_of_both_packages_are_there() -> None:
    """Found by their annotation, and compared with the packages' own lists."""
    names = {example.name for example in EXAMPLES}
    assert {*models_in("Examples"), *models_in("Validation")} <= names
    assert "HydraulicTestBenchMSL.Examples.Payload" in names


def test_exceptions_are_for_examples_there_are_and_have_reasons() -> None:
    shorts = {example.short for example in EXAMPLES}
    assert {*LIMITS, *REFUSED} <= shorts
    assert all(len(limit.reason) > 20 and limit.tolerance <= 1e-4 for limit in LIMITS.values())
    assert all(example.limit.tolerance == 1e-5 for example in EXAMPLES if example.short not in LIMITS)


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda example: example.short)
def test_each_has_a_stored_result_over_its_experiment(example: Example) -> None:
    if example.short in REFUSED:
        assert not example.file.exists()
        return
    columns = stored.read(example)
    assert np.allclose(columns["time"], example.times, rtol=1e-8)
    assert 1 < len(columns) <= WIDEST + 1
    assert all(values.shape == (ROWS,) and np.isfinite(values).all() for values in columns.values())


def test_no_stored_result_is_left_over() -> None:
    assert {path.name for path in RESULTS.iterdir()} == {e.file.name for e in EXAMPLES if e.short not in REFUSED}


def test_names_and_times() -> None:
    own = Example("HydraulicTestBench.Examples.X", 60.0, Limit(until=20.0))
    assert (own.short, own.times[-1], own.times.size) == ("Examples.X", 20.0, ROWS)
    assert Example("HydraulicTestBenchMSL.Examples.X", 1.0).short == "MSL.Examples.X"


def test_a_missing_standard_library_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("MODELICAPATH", raising=False)
    assert libraries_of(Example("HydraulicTestBench.Examples.X", 1.0)) == []
    with pytest.raises(LookupError, match=r"no Modelica 4\.0\.0 on MODELICAPATH"):
        libraries_of(Example("HydraulicTestBenchMSL.Examples.X", 1.0))
