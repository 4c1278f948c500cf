"""The wheel: what is in it, and that it works without the clone."""

import os
import subprocess
import sys
import tomllib
import zipfile
from collections.abc import Iterator
from email import message_from_string
from email.message import Message
from pathlib import Path

import pytest

from fmu_build.version import version

ROOT = Path(__file__).parents[1]
MOST = 2_000_000  # bytes of all that `pysim` brings along, compressed
SAYS = """
import sys
from pathlib import Path
import fmu_build, pysim
from fmu_build.build import bundled_library
from pysim.effects import STANDARD_LIBRARY, read_catalogue
from pysim.thesis import measured_responses
assert bundled_library() == STANDARD_LIBRARY == Path(fmu_build.__file__).parent / "modelica" / "HydraulicTestBench"
print(Path(pysim.__file__).parents[1], len(read_catalogue(STANDARD_LIBRARY)) > 20, len(measured_responses()))
print(fmu_build.build("HydraulicTestBench.Controllers.Gain", "gain.fmu"))
"""


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Iterator[zipfile.ZipFile]:
    pytest.importorskip("hatchling")
    from hatchling.builders.wheel import WheelBuilder

    (path,) = WheelBuilder(str(ROOT)).build(directory=str(tmp_path_factory.mktemp("dist")), versions=["standard"])
    with zipfile.ZipFile(path) as found:
        yield found


@pytest.fixture(scope="module")
def about(wheel: zipfile.ZipFile) -> Message:
    (name,) = (name for name in wheel.namelist() if name.endswith(".dist-info/METADATA"))
    return message_from_string(wheel.read(name).decode())


def test_it_lists_two_packages(wheel: zipfile.ZipFile) -> None:
    tops = {name.split("/")[0] for name in wheel.namelist()}
    assert {top for top in tops if not top.endswith(".dist-info")} == {"fmu_build", "pysim"}
    names = set(wheel.namelist())
    assert {"pysim/py.typed", "pysim/app/static/app.css", "pysim/simulate/kernel/src/kernel.h"} <= names
    assert {"fmu_build/modelica/HydraulicTestBench/package.order", "fmu_build/runtime/src/cosim.c"} <= names
    assert not [name for name in names if "/test/" in name or "__pycache__" in name]


def test_it_is_small(wheel: zipfile.ZipFile) -> None:
    sizes = [item.compress_size for item in wheel.infolist() if item.filename.startswith("pysim/")]
    prebuilt = [i.compress_size for i in wheel.infolist() if i.filename.startswith("pysim/simulate/kernel/prebuilt/")]
    assert sum(sizes) - sum(prebuilt) < MOST


def test_what_it_says_of_itself(about: Message) -> None:
    assert (about["Name"], about["Version"]) == ("hydraulic-test-bench", version())
    extras = {"all", "app", "cluster", "data", "notebook", "openmodelica"}
    assert extras <= set(about.get_all("Provides-Extra", [])) <= extras | {"docs"}
    needed: dict[str, set[str]] = {extra: set() for extra in extras}
    for one in about.get_all("Requires-Dist", []):
        need, _, extra = one.partition("; extra == ")
        if extra.strip("'\"") in needed:
            needed[extra.strip("'\"")].add(need)
    assert needed["all"] == set.union(*(needed[extra] for extra in extras - {"all"}))


def test_without_the_clone_it_finds_its_library_and_builds(wheel: zipfile.ZipFile, tmp_path: Path) -> None:
    """Unpacked as pip would, and started in an empty folder."""
    installed, empty = tmp_path / "site", tmp_path / "empty"
    wheel.extractall(installed)
    empty.mkdir()

    def python(*words: str) -> subprocess.CompletedProcess[str]:
        environment = {**os.environ, "PYTHONPATH": str(installed)}
        return subprocess.run(
            [sys.executable, *words], cwd=empty, env=environment, capture_output=True, text=True, check=False
        )

    done = python("-c", SAYS)
    assert done.stdout.splitlines() == [f"{installed} True 18", "gain.fmu"], done.stderr
    assert python("-m", "pysim", "--version").stdout == f"pysim {version()}\n"


def test_dependency_groups_are_no_extras() -> None:
    said = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    assert {"test", "lint"} <= set(said["dependency-groups"])
    assert not {"test", "lint"} & set(said["project"]["optional-dependencies"])
