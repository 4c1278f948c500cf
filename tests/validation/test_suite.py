"""Running cases: what stops one does not stop the next."""

import pytest

from pysim.types import BadInput
from tests.validation import made_up
from validation.suite import chosen, run_cases


@pytest.fixture(autouse=True)
def _cases(monkeypatch: pytest.MonkeyPatch) -> None:
    made_up.use(monkeypatch)


def test_which_cases() -> None:
    assert chosen([], quick=False) == ["good", "bad", "nan", "broken"]
    assert chosen([], quick=True) == ["good"]
    assert chosen(["bad", "good"], quick=True) == ["good"]
    with pytest.raises(BadInput, match="no case named none; there are good, bad"):
        chosen(["none"], quick=False)


def test_results_come_one_by_one(capsys: pytest.CaptureFixture[str]) -> None:
    seen = []
    results = list(run_cases(["broken", "good"], lambda name, finding: seen.append((name, finding))))
    assert [(r.case, r.verdict, r.error) for r in results] == [
        ("broken", "fails", "ValueError: no good"),
        ("good", "holds", ""),
    ]
    assert seen == [
        ("broken", None),
        ("broken", made_up.GOOD[0]),
        ("good", None),
        *(("good", finding) for finding in made_up.GOOD),
    ]
    assert "no good" in capsys.readouterr().err
