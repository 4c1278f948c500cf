"""The page that compares: what stands in its table and on its buttons."""

from dataclasses import replace

from pysim.app.pages.compare import _points, _row
from tests.pysim.diagnosis_story import dataset


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
