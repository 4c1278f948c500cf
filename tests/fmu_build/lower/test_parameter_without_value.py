"""A parameter nobody gave a value is an error, not zero."""

from pathlib import Path

import pytest

from fmu_build.errors import BuildError
from fmu_build.front import load
from fmu_build.lower import lower


@pytest.mark.parametrize("attribute", ["", '(unit = "m")'])
def test_it_is_named_with_its_place_and_the_cure(attribute: str, tmp_path: Path) -> None:
    file = tmp_path / "M.mo"
    file.write_text(f"model M\n  parameter Real p{attribute};\n  Real x = p*time;\nend M;", encoding="utf-8")
    with pytest.raises(BuildError, match=r"p has no value; .* --set p=") as caught:
        lower(load("M", [file]))
    assert (caught.value.file, caught.value.line) == (file, 2)
    assert lower(load("M", [file], {"p": 3})).name == "M"


def test_a_start_value_of_zero_is_a_value(tmp_path: Path) -> None:
    file = tmp_path / "M.mo"
    file.write_text("model M parameter Real p(start = 0); Real x = p*time; end M;", encoding="utf-8")
    assert lower(load("M", [file])).name == "M"
