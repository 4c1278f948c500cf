"""The check every FMU has to pass."""

import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

from fmu_build.errors import BuildError
from fmu_build.pack import select_platforms
from fmu_build.pack.fmu import pack
from fmu_build.pack.validation import validate_foreign, validate_own
from tests import ode_models
from tests.fmu_build.openmodelica.repack import repacked


@pytest.fixture(scope="module")
def good(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("fmu") / "good.fmu"
    pack(ode_models.oscillator(), path, fmi=2, platforms=select_platforms(["host"]))
    return path


def changed(good: Path, folder: Path, old: bytes, new: bytes) -> Path:
    with zipfile.ZipFile(good) as archive:
        text = archive.read("modelDescription.xml")
    assert old in text
    return repacked(good, folder / "bad.fmu", {"modelDescription.xml": text.replace(old, new)})


def test_what_keeps_to_it_is_taken(good: Path) -> None:
    validate_own(good)
    validate_foreign(good)


@pytest.mark.parametrize("validate", [validate_own, validate_foreign])
@pytest.mark.parametrize(
    ("old", "new", "finding"),
    [
        (b'valueReference="', b'valueReferenz="', "valueReferenz"),  # the schema
        (b'name="k"', b'name="m"', "not unique"),
        (b'causality="output"', b'causality="local"', "ModelStructure/Outputs"),
    ],
)
def test_what_breaks_the_standard_is_refused(
    good: Path, tmp_path: Path, validate: Callable[[Path], None], old: bytes, new: bytes, finding: str
) -> None:
    with pytest.raises(BuildError, match=f"does not pass FMPy's validation: .*{finding}"):
        validate(changed(good, tmp_path, old, new))


def test_names_of_another_compilers_fmu_are_read_too(good: Path, tmp_path: Path) -> None:
    with pytest.raises(BuildError, match="not a legal variable name"):
        validate_foreign(changed(good, tmp_path, b'name="zeta"', b'name="zeta of k"'))
