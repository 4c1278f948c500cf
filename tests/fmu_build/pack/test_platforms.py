"""Names of platforms."""

import platform

import pytest

from fmu_build.errors import BuildError
from fmu_build.pack import PLATFORMS, host_platform, select_platforms


def test_a_host_we_cannot_build_for(monkeypatch):
    monkeypatch.setattr(platform, "machine", lambda: "riscv64")
    with pytest.raises(BuildError, match="riscv64"):
        host_platform()


def test_selection_has_each_platform_once():
    assert select_platforms(["aarch64-linux", "host", "all"]) == PLATFORMS
    assert [p.name for p in select_platforms(["x86_64-windows", "x86_64-linux", "x86_64-windows"])] == [
        "x86_64-linux",
        "x86_64-windows",
    ]


@pytest.mark.parametrize("names", [["amiga"], []])
def test_unknown_platforms_are_refused_with_the_choice(names):
    with pytest.raises(BuildError, match="x86_64-windows"):
        select_platforms(names)


def test_folders_of_fmi_2():
    assert [p.folder(2) for p in PLATFORMS] == ["linux64", "win64", "darwin64", "aarch64-linux", "darwin64"]
    assert all(p.folder(3) == p.name for p in PLATFORMS)
