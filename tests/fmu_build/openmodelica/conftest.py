"""A machine with OpenModelica, and one without."""

import json
import os
import stat
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from fmu_build.openmodelica import installation
from fmu_build.pack import select_platforms
from fmu_build.pack.fmu import pack
from tests import ode_models
from tests.conftest import new_cache
from tests.fmu_build.openmodelica.repack import as_of_omc

FAKE = Path(__file__).with_name("fake_omc.py")


@pytest.fixture(scope="session")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An FMU as omc would leave it, with its flags for CVODE."""
    folder = tmp_path_factory.mktemp("omc")
    own = folder / "own.fmu"
    pack(ode_models.oscillator(), own, fmi=2, platforms=select_platforms(["host"]))
    return as_of_omc(own, folder / "omc.fmu")


@pytest.fixture
def omc(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, built: Path) -> Callable[..., Path]:
    """`omc(refuses=..., ...)` says how the installed omc behaves, and gives the file of what it is asked."""
    pytest.importorskip("OMPython")
    if os.name == "nt":
        pytest.skip("the program that stands for omc is a script with a shebang line")
    home = tmp_path / "openmodelica"
    (home / "bin").mkdir(parents=True)
    program = home / "bin" / "omc"
    program.write_text(f"#!{sys.executable}\n" + FAKE.read_text(encoding="utf-8"), encoding="utf-8")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setenv("OPENMODELICAHOME", str(home))
    monkeypatch.setenv("FAKE_OMC", str(tmp_path / "told.json"))
    monkeypatch.setenv("HTB_CACHE", str(new_cache(tmp_path / "cache")))
    monkeypatch.setattr(installation, "is_root", lambda: False)

    def behave(**told: Any) -> Path:
        log = tmp_path / "asked.txt"
        (tmp_path / "told.json").write_text(json.dumps({"fmu": str(built), "log": str(log), **told}))
        return log

    behave()
    return behave


@pytest.fixture
def no_omc(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("OPENMODELICAHOME", raising=False)
    monkeypatch.setenv("PATH", str(tmp_path))
