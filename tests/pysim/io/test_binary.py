"""An FMU for another machine is told as that."""

import zipfile
from pathlib import Path

import pytest

from pysim.io import check_binary, read_model
from pysim.types import BadInput
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
