"""The library is made once, and taken only as it was made."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from pysim.simulate.kernel import build
from pysim.types import BadInput


@pytest.fixture
def empty(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A cache that holds nothing, and a package without libraries."""
    cache = tmp_path / "cache"
    cache.mkdir()
    monkeypatch.setattr(build, "cache_folder", lambda purpose: cache)
    monkeypatch.setattr(build, "PREBUILT", tmp_path / "prebuilt")
    return cache


def test_a_library_is_compiled_once(empty: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    ready, calls = build.PREBUILT.parent / "ready", []
    ready.write_bytes(b"machine code")

    def compiled(name: str, library: Path) -> None:
        calls.append(name)
        shutil.copy(ready, library)

    monkeypatch.setattr(build, "compile_for", compiled)
    assert not build.kernel_is_built()
    first = build.build_kernel()
    assert first.read_bytes() == b"machine code"
    assert build.build_kernel() == first
    assert build.kernel_is_built()
    assert calls == [build.this_platform()]
    assert list(empty.iterdir()) == [first]
    monkeypatch.setattr(build, "FLAGS", (*build.FLAGS, "-DOTHER"))
    assert not build.kernel_is_built()


def test_a_changed_library_is_refused(empty: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(build, "compile_for", lambda name, library: library.write_bytes(b"machine code"))
    build.build_kernel().write_bytes(b"another")
    with pytest.raises(BadInput, match="changed"):
        build.build_kernel()


def test_a_library_in_the_package_is_taken_first(empty: Path) -> None:
    suffix = build.TARGETS[build.this_platform()][1]
    ready = build.PREBUILT / build.this_platform() / f"kernel-{build.source_key()}{suffix}"
    ready.parent.mkdir(parents=True)
    ready.touch()
    assert build.build_kernel() == ready
    assert not any(empty.iterdir())


def test_what_the_compiler_refuses_is_said(empty: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(build, "FLAGS", (*build.FLAGS, "-fno-such-flag"))
    with pytest.raises(BadInput, match="no-such-flag"):
        build.build_kernel()
    assert not any(empty.iterdir())


@pytest.mark.slow
def test_it_can_be_compiled_for_every_platform(tmp_path: Path) -> None:
    heads = {".so": b"\x7fELF", ".dll": b"MZ", ".dylib": b"\xcf\xfa\xed\xfe"}
    made = build.build_all(tmp_path)
    assert [path.parent.name for path in made] == list(build.TARGETS)
    for path in made:
        assert path.read_bytes().startswith(heads[path.suffix])
