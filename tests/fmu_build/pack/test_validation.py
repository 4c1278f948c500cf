"""The check every FMU has to pass."""

import zipfile

import pytest

from fmu_build.errors import BuildError
from fmu_build.pack import select_platforms
from fmu_build.pack.fmu import pack
from fmu_build.pack.validation import validate
from tests import ode_models


def test_a_good_one_passes_and_one_against_the_standard_does_not(tmp_path):
    good, bad = tmp_path / "good.fmu", tmp_path / "bad.fmu"
    pack(ode_models.oscillator(), good, fmi=2, platforms=select_platforms(["host"]))
    validate(good)
    with zipfile.ZipFile(good) as old, zipfile.ZipFile(bad, "w") as new:
        for name in old.namelist():
            new.writestr(name, old.read(name).replace(b'valueReference="', b'valueReferenz="'))
    with pytest.raises(BuildError, match=r"does not pass FMPy's validation: .*valueReferenz"):
        validate(bad)
