"""An FMU for another machine is told as that, and one whose library cannot be loaded."""

import os
import zipfile
from pathlib import Path

import pytest
from fmpy.fmi2 import FMU2Model
from fmpy.fmi3 import FMU3Model

from pysim.io import check_binary, load_library, read_model
from pysim.types import BadInput
from tests.broken import with_broken_library
from tests.pysim.simulate.text_models import LAG, text_model


def test_the_machines_it_is_for_are_named(tmp_path: Path) -> None:
    own = text_model(LAG, tmp_path)
    check_binary(own, own.abilities.library)
    with pytest.raises(BadInput, match=r"has no binary for \w+ \(it has: \w+\); export it"):
        check_binary(own, "another")
    with zipfile.ZipFile(own.path) as archive, zipfile.ZipFile(tmp_path / "bare.fmu", "w") as bare:
        bare.writestr("modelDescription.xml", archive.read("modelDescription.xml"))
    with pytest.raises(BadInput, match=r"bare\.fmu has no binary for .* \(it has: none\)"):
        check_binary(read_model(tmp_path / "bare.fmu"), own.abilities.library)


@pytest.mark.parametrize(("fmi", "kind"), [(2, FMU2Model), (3, FMU3Model)])
def test_a_library_that_cannot_be_loaded_is_told_and_leaves_the_working_directory(
    tmp_path: Path, fmi: int, kind: type
) -> None:
    model = read_model(with_broken_library(text_model(LAG, tmp_path, fmi=fmi).path, tmp_path / "broken.fmu"))
    before = os.getcwd()
    with pytest.raises(BadInput, match=r"^broken\.fmu: its library Lag cannot be loaded \(.*\); install what it needs"):
        load_library(kind, model, "Lag", "lag")
    assert os.getcwd() == before


def test_an_fmu_that_has_become_another_since_it_was_read_is_told(tmp_path: Path) -> None:
    model = text_model(LAG, tmp_path)
    copy = tmp_path / "mine.fmu"
    copy.write_bytes(model.path.read_bytes())
    mine = read_model(copy)
    os.utime(copy, ns=(1, 1))  # copied back, with another time
    check_binary(mine, "Lag")
    (tmp_path / "other").mkdir()
    other = text_model(LAG.replace("parameter Real", "parameter Real more = 1; parameter Real", 1), tmp_path / "other")
    copy.write_bytes(other.path.read_bytes())
    with pytest.raises(BadInput, match=r"^mine\.fmu has become another since it was read; read it again"):
        check_binary(mine, "Lag")
    copy.unlink()
    with pytest.raises(BadInput, match=r"^mine\.fmu is not at .*mine\.fmu any more; export it again"):
        check_binary(mine, "Lag")
