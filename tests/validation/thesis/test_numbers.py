"""What the thesis says in numbers, and the folders that hold them."""

from pathlib import Path

import pytest

import validation.thesis
from validation.registry import CASES
from validation.thesis.numbers import published

FOLDERS = sorted(path.parent for path in Path(validation.thesis.__file__).parent.glob("*/case.py"))


def test_numbers_by_name() -> None:
    told = published(str(FOLDERS[[f.name for f in FOLDERS].index("figure_2_4")] / "case.py"))
    assert told["fit"] == 89.81


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_every_result_is_registered_and_says_what_it_is(folder: Path) -> None:
    name = folder.name.replace("_", "-")
    assert CASES[name].module == f"validation.thesis.{folder.name}.case"
    text = (folder / "README.md").read_text(encoding="utf-8")
    assert f"python3 run.py validate {name}" in text
    assert "thesis" in text
