"""The drive of docs/tutorials/own_model.md: a fit not to be trusted, and one that is once its friction is found."""

import shutil
from pathlib import Path

import pytest

import pysim
from tests.test_docs import ROOT, blocks, commands, execute


@pytest.mark.slow
def test_the_drive_is_not_trusted_until_what_it_lacks_is_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    shutil.copytree(ROOT / "docs" / "tutorials" / "drive", ".", dirs_exist_ok=True)
    shutil.copy(ROOT / "pysim" / "nouns" / "examples" / "Drive.mo", ".")
    page = blocks((ROOT / "docs" / "tutorials" / "own_model.md").read_text(encoding="utf-8"))
    machine = next(source for words, _, source in page if words == "sh run")  # builds it and measures
    assert [execute(command) for _, command in commands(machine, 0)][:2] == [0, 0]
    data = pysim.load("measurements")
    fitted = pysim.fit(pysim.model("Drive.Axis", library="Drive.mo"), data)
    print(*fitted.warnings, sep="\n")
    assert len(fitted.warnings) >= 2
    assert not fitted.ok
    why = pysim.diagnose(fitted)
    assert why.verdict == "axis.friction"
    again = pysim.fit(why.model, data)
    print(why, again, sep="\n")
    assert again.ok, again.warnings
    assert again.intervals["guideway.F_c"][0] < 60 < again.intervals["guideway.F_c"][1]
