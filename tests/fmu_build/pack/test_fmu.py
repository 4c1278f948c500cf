"""An FMU for several platforms."""

import os
import re
import threading
import zipfile

import pytest

from fmu_build.pack import PLATFORMS, CompilerError, fmu
from tests import ode_models
from tests.fmu_build.pack.test_mach_o import ARM64, X86_64, thin

MAC = {"x86_64-darwin": thin(X86_64, 9), "aarch64-darwin": thin(ARM64, 5)}
OSCILLATOR = ode_models.oscillator()


@pytest.mark.parametrize("fmi", [2, 3])
def test_platforms_are_compiled_side_by_side_and_each_library_is_in_its_place(tmp_path, monkeypatch, fmi):
    """The stand-in for the compiler waits until called for all. In FMI 2 the processors of macOS share a file."""
    all_at_once = threading.Barrier(len(PLATFORMS), timeout=60)

    def compile_shared(sources, includes, platform, library):
        all_at_once.wait()
        library.write_bytes(b"nobody else's")  # fails where it cannot be written
        return MAC.get(platform.name, platform.name.encode())

    monkeypatch.setattr(os, "cpu_count", lambda: len(PLATFORMS))
    monkeypatch.setattr(fmu, "compile_shared", compile_shared)
    fmu.pack(OSCILLATOR, tmp_path / "m.fmu", fmi=fmi, platforms=PLATFORMS)
    with zipfile.ZipFile(tmp_path / "m.fmu") as archive:
        found = {n.split("/")[1]: archive.read(n) for n in archive.namelist() if n.startswith("binaries/")}
    assert set(found) == {platform.folder(fmi) for platform in PLATFORMS}
    for platform in PLATFORMS:
        library = found[platform.folder(fmi)]
        if fmi == 2 and platform.name in MAC:
            assert all(one in library for one in MAC.values())
        else:
            assert library == MAC.get(platform.name, platform.name.encode())


def test_a_platform_that_does_not_compile_leaves_no_fmu(tmp_path, monkeypatch):
    def compile_shared(sources, includes, platform, library):
        if platform.suffix == ".dll":
            raise CompilerError(f"{platform.name}: the C compiler failed.")
        return MAC.get(platform.name, b"fine")

    monkeypatch.setattr(fmu, "compile_shared", compile_shared)
    with pytest.raises(CompilerError, match="x86_64-windows: the C compiler failed"):
        fmu.pack(OSCILLATOR, tmp_path / "m.fmu", fmi=2, platforms=PLATFORMS)
    assert list(tmp_path.iterdir()) == []


def test_it_says_which_version_made_it_and_keeps_its_token(tmp_path, monkeypatch):
    found = set()
    for version in ("0.2.0", "0.3.0.post1+gabc"):
        monkeypatch.setattr(fmu, "version", lambda version=version: version)
        fmu.pack(OSCILLATOR, tmp_path / "m.fmu", fmi=2, platforms=[])
        with zipfile.ZipFile(tmp_path / "m.fmu") as archive:
            text = archive.read("modelDescription.xml").decode()
        assert f'generationTool="fmu_build {version}"' in text
        found.add(re.search('guid="([^"]+)"', text)[1])
    assert len(found) == 1
