"""The page that compares: what stands in its table and on its buttons."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

from pysim.app.pages.compare import _errors, _points, _row, _worst
from tests.pysim.diagnosis_answer import dataset


def test_points_are_told_with_their_units() -> None:
    sine = replace(dataset().records[0], command="p", offset=1e7, amplitude=2e6)
    row = _row(sine, "Pa", [2.0], 2)
    assert row[2:5] == [{"text": "100 bar", "value": 1e7}, {"text": "20 bar", "value": 2e6}, "1"]
    assert [cell if cell == "" else cell["text"] for cell in row[5:]] == ["2.00", ""]
    signals = (replace(dataset().signals[0], name="p", unit="Pa"), dataset().signals[1])
    data = replace(dataset(), signals=signals, records=(sine,))
    tests = [{"input": "command", "output": name, "offset": 1e7, "amplitude": 2e6} for name in ("x", "v")]
    assert _points(tests[:1], data) == ["100 ± 20 bar"]
    assert _points(tests, data) == ["100 ± 20 bar, x", "100 ± 20 bar, v"]


def test_two_records_of_one_file_have_each_its_own_error() -> None:
    wave, held = dataset().records[2:]
    data = replace(dataset(), records=(wave, replace(held, source=wave.source)))
    errors = {0: (3.0, 1.0), 1: (8.0, 2.0)}
    stages = [{"records": [{"index": n, "rms": [own[k]]} for n, own in reversed(errors.items())]} for k in (0, 1)]
    answer: Any = SimpleNamespace(base=stages[0], last=stages[1], added=("toy.offset",))
    assert _errors(answer) == {0: [3.0, 1.0], 1: [8.0, 2.0]}
    assert _worst(data.logs(), _errors(answer)) == 1


def test_a_record_that_the_base_model_could_not_simulate_has_no_error_of_it() -> None:
    logs = dataset().logs()
    stages = [
        {"records": [{"index": k, "rms": [3.0]} for k in range(1, len(logs))]},
        {"records": [{"index": k, "rms": [1.0 + k]} for k in range(len(logs))]},
    ]
    answer: Any = SimpleNamespace(base=stages[0], last=stages[1], added=("toy.offset",))
    found = _errors(answer)
    assert found[0] == [None, 1.0]
    assert found[1] == [3.0, 2.0]
    assert [cell and cell["text"] for cell in _row(logs[0], "Pa", found[0], 2)[5:]] == ["", "1.00"]
    assert _worst(logs, found) == len(logs) - 1
