"""What is said where OpenModelica cannot be used."""

import importlib.util

import pytest

from fmu_build import BuildError
from fmu_build.openmodelica import installation, omc_version, what_is_missing


def test_an_installed_one_is_found(omc):
    assert what_is_missing() == ""
    assert installation.find_omc() is not None
    assert omc_version() == "OpenModelica 1.28.0"


@pytest.mark.usefixtures("no_omc")
def test_a_missing_omc_is_said_with_its_cure():
    assert "get it from openmodelica.org" in what_is_missing()
    with pytest.raises(BuildError, match="omc is not installed"):
        omc_version()


def test_a_folder_named_wrongly_is_not_passed_over(omc, monkeypatch, tmp_path):
    """OMPython looks below $OPENMODELICAHOME alone where it is set; a program elsewhere would not be the one."""
    monkeypatch.setenv("OPENMODELICAHOME", str(tmp_path / "nowhere"))
    assert "OPENMODELICAHOME" in what_is_missing()


def test_a_missing_ompython_is_said_with_its_cure(omc, monkeypatch):
    find = importlib.util.find_spec
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None if name == "OMPython" else find(name))
    assert what_is_missing().endswith("pip install OMPython")


def test_root_is_told_why(omc, monkeypatch):
    monkeypatch.setattr(installation, "is_root", lambda: True)
    assert "does not serve the user root" in what_is_missing()


def test_an_omc_that_fails_is_reported(omc, tmp_path):
    program = tmp_path / "openmodelica" / "bin" / "omc"
    program.write_text("#!/bin/sh\necho cannot open shared object file >&2\nexit 127\n")
    with pytest.raises(BuildError, match="ends with 127: cannot open shared object file; reinstall"):
        omc_version()
