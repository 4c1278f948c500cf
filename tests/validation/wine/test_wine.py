"""Without Wine the case says so and claims nothing."""

import pytest

from validation.wine import case


def test_says_so_where_there_is_no_wine(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(case.shutil, "which", lambda name: None)
    (finding,) = case.run()
    assert "apt-get install wine64" in finding.skipped
    assert not finding.holds
    assert str(finding).startswith("skipped")
