"""A name that is not there, in texts of several files: its place is that of the file that writes it."""

import textwrap
from pathlib import Path

import pytest

from fmu_build.errors import BuildError
from fmu_build.front import load
from fmu_build.front.rumoca.failures import UnresolvedName


def test_a_part_inside_a_part_whose_library_is_not_named(tmp_path: Path) -> None:
    (tmp_path / "Q.mo").write_text("model Q\n  Drives.Motor motor;\nend Q;\n", encoding="utf-8")
    (tmp_path / "P.mo").write_text("model P\n  Q q;\n  Real w = q.motor.w;\nend P;\n", encoding="utf-8")
    with pytest.raises(UnresolvedName, match="motor is a Drives") as caught:
        load("P", [tmp_path / "P.mo", tmp_path / "Q.mo"])
    assert (caught.value.file, caught.value.line) == (tmp_path / "Q.mo", 2)


def test_in_a_library_it_is_the_file_of_the_name(tmp_path: Path) -> None:
    library = tmp_path / "L"
    library.mkdir()
    (library / "package.mo").write_text("package L\nend L;\n", encoding="utf-8")
    part = library / "Part.mo"
    part.write_text(
        textwrap.dedent("""\
            within L;
            model Part

              Real a = nothing;
            end Part;
            """),
        encoding="utf-8",
    )
    (library / "Whole.mo").write_text("within L;\nmodel Whole\n  Part part;\nend Whole;\n", encoding="utf-8")
    with pytest.raises(UnresolvedName) as caught:
        load("L.Whole", [library])
    assert (caught.value.file, caught.value.line) == (part, 4)


@pytest.mark.parametrize("text", ["model M Real x); equation x = 1; end M;", "model M Real x]; end M;"])
def test_a_bracket_too_many_is_a_syntax_error_at_its_line(text: str, tmp_path: Path) -> None:
    (tmp_path / "M.mo").write_text(text, encoding="utf-8")
    with pytest.raises(BuildError, match=r"M\.mo:1: syntax error"):
        load("M", [tmp_path / "M.mo"], {})
