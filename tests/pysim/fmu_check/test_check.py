"""Wrong use of the check, and what its results say of themselves."""

from pathlib import Path

import pytest

from pysim.fmu_check import check_fmu
from pysim.fmu_check.check import _work
from pysim.fmu_check.result import CheckResult, none_of, within
from pysim.types import BadInput
from tests.planted import planted


def test_wrong_use(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match="no FMU at"):
        check_fmu(tmp_path / "none.fmu")
    with pytest.raises(BadInput, match="no check named luck; there are description"):
        check_fmu(planted("NONE", tmp_path), ("luck",))


def test_a_worker_that_cannot_begin_is_told_in_its_last_words(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match=r"none\.fmu cannot be tried: .*no FMU at"):
        _work(tmp_path / "none.fmu", ("order",), 30.0, lambda done: None)


def test_verdicts() -> None:
    assert within("a", "b", 1.0, 1.0, "s").verdict == "holds"
    assert within("a", "b", float("nan"), 1.0, "s").verdict == "fails"
    many = none_of("a", "b", [f"v{k}" for k in range(9)])
    assert (many.verdict, many.detail) == ("fails", "v0, v1, v2, v3, v4, v5 and 3 more")
    assert none_of("a", "b", [], note="n").verdict == "holds"


def test_words_and_data() -> None:
    words = str(CheckResult("runs", "close", "fails", "why", 0.25, 0.1, "m"))
    assert words.split() == ["fails", "runs:", "close", "(0.25,", "limit", "0.1", "m):", "why"]
    assert CheckResult("runs", "close", "fails", value=float("nan")).data()["value"] is None
