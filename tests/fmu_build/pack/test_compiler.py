"""Compiling for several platforms, and failing."""

import pytest

from fmu_build.errors import BuildError
from fmu_build.pack import PLATFORMS, CompilerError, compiler, host_platform
from fmu_build.pack.compiler import compile_shared

SOURCE = """int hidden(int a);
int hidden(int a) { return a + 1; }
__attribute__((visibility("default"))) int shown(int a);
int shown(int a) { return hidden(a); }
"""
HEADS = {".so": b"\x7fELF", ".dylib": b"\xcf\xfa\xed\xfe", ".dll": b"MZ"}
# The first compilation for another system takes seconds, for Windows minutes.
SYSTEMS = [
    pytest.param(platform, marks=[] if platform == host_platform() else pytest.mark.slow, id=platform.name)
    for platform in PLATFORMS
    if platform.suffix != ".dll"
]


@pytest.mark.parametrize("platform", SYSTEMS)
def test_a_library_in_the_platforms_format(tmp_path, platform):
    (tmp_path / "a.c").write_text(SOURCE)
    library = compile_shared([tmp_path / "a.c"], [], platform, tmp_path / f"m{platform.suffix}")
    assert library.startswith(HEADS[platform.suffix])
    assert str(tmp_path).encode() not in library
    assert b"shown" in library
    assert b"hidden" not in library


def test_the_place_of_the_sources_does_not_matter(tmp_path):
    found = set()
    for name in ("one", "another"):
        folder = tmp_path / name
        folder.mkdir()
        (folder / "a.c").write_text(SOURCE)
        found.add(compile_shared([folder / "a.c"], [], host_platform(), folder / "m.so"))
    assert len(found) == 1


def test_a_warning_is_an_error(tmp_path):
    (tmp_path / "a.c").write_text("static int unused(void) { return 1; }\n")
    with pytest.raises(CompilerError, match=r"a\.c:1.*unused"):
        compile_shared([tmp_path / "a.c"], [], host_platform(), tmp_path / "m.so")


def test_without_ziglang_it_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setattr(compiler.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(BuildError, match="pip install ziglang"):
        compile_shared([tmp_path / "a.c"], [], host_platform(), tmp_path / "m.so")


def test_a_compiler_that_takes_too_long_is_told_with_a_cure(tmp_path, monkeypatch):
    (tmp_path / "a.c").write_text(SOURCE)
    monkeypatch.setattr(compiler, "_LONGEST_S", 1e-6)
    with pytest.raises(BuildError, match="was not done after 1e-06 s; try again"):
        compile_shared([tmp_path / "a.c"], [], host_platform(), tmp_path / "m.so")
