"""The form for logs that nobody has described: what was chosen stays while logs come in."""

from pathlib import Path
from types import SimpleNamespace
from typing import Any

from pysim.app.pages.bare import _draft


def log(path: Path, head: str = "t [s],F [N],x [mm]") -> Path:
    path.write_text("\n".join([head, *(f"{k / 10},{k % 3},{k % 5}" for k in range(20))]))
    return path


def test_a_log_more_of_the_same_columns_leaves_what_was_chosen(tmp_path: Path) -> None:
    desk: Any = SimpleNamespace(draft={}, model=None)
    first = log(tmp_path / "b.csv")
    _draft(desk, [first])["columns"][1]["role"] = "output"
    desk.draft["kind"] = "step"
    found = _draft(desk, [log(tmp_path / "a.csv"), first])
    assert (found["columns"][1]["role"], found["kind"]) == ("output", "step")
    found = _draft(desk, [log(tmp_path / "a.csv", "t [s],G [N],x [mm]"), first])
    assert (found["columns"][1]["role"], found["kind"]) == ("input", "other")
