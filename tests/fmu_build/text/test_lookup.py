"""What names mean in libraries on disk."""

from pathlib import Path

import pytest

from fmu_build.text import Libraries, TextError

PACKAGE = """within ;
package Lib
  constant Real c = 1;
  model Base replaceable Part part; Part second; end Base;
  model Part type Inner = Real; end Part;
end Lib;
"""
SUB = """within Lib;
package Sub
  import P = Lib.Part;
  import Lib.*;
  model Part end Part;
  model M
    extends Base(redeclare Sub.Part part);
    P.Inner x;
    Nothing y;
  end M;
  model 'a.b' end 'a.b';
end Sub;
"""


@pytest.fixture
def library(tmp_path: Path) -> Path:
    (tmp_path / "Lib").mkdir()
    (tmp_path / "Lib" / "package.mo").write_text(PACKAGE)
    (tmp_path / "Lib" / "Sub.mo").write_text(SUB)
    return tmp_path / "Lib"


def test_names_are_looked_for_from_inside_out(library: Path) -> None:
    libraries = Libraries([library])
    model = libraries.find("Lib.Sub.M")
    meant = {name: libraries.resolve(name, model) for name in ("Part", "Lib.Part", ".Lib.Part", "P", "P.Inner", "Base")}
    assert {name: found.full_name for name, found in meant.items() if found} == {
        "Part": "Lib.Sub.Part", "Lib.Part": "Lib.Part", ".Lib.Part": "Lib.Part", "P": "Lib.Part",
        "P.Inner": "Lib.Part.Inner", "Base": "Lib.Base",
    }  # fmt: skip
    assert libraries.resolve("Nothing", model) is None
    assert [one.full_name for one in libraries.ancestry(model)] == ["Lib.Sub.M", "Lib.Base"]
    assert {one.full_name for one in libraries.used(model)} == {
        "Lib.Sub.M", "Lib.Base", "Lib.Sub.Part", "Lib.Part.Inner", "Lib.Part",
    }  # fmt: skip
    assert [owner.full_name for owner, _ in libraries.elements("second", model)] == ["Lib.Base"]
    assert libraries.find("Lib.Sub.'a.b'").place(0)[0] == library / "Sub.mo"


def test_all_classes_and_those_of_files_that_hold_a_word(library: Path, tmp_path: Path) -> None:
    other = tmp_path / "Other.mo"
    other.write_text("package Lib model Base end Base; end Lib;\nmodel Own end Own;\n")
    names = [one.full_name for one in Libraries([library, other]).classes()]
    assert names == [
        "Lib.Sub", "Lib.Sub.Part", "Lib.Sub.M", "Lib.Sub.'a.b'", "Lib", "Lib.Base", "Lib.Part", "Lib.Part.Inner", "Own",
    ]  # fmt: skip
    assert [one.full_name for one in Libraries([library, other]).classes("Own")] == ["Own"]


def test_a_class_inside_one_is_found_in_whichever_library_of_that_name_has_it(tmp_path: Path) -> None:
    for folder, inner in (("first", ""), ("second", "model Y end Y;")):
        (tmp_path / folder / "L").mkdir(parents=True)
        (tmp_path / folder / "L" / "package.mo").write_text("package L end L;")
        (tmp_path / folder / "L" / "X.mo").write_text(f"within L; model X {inner} end X;")
    both = Libraries([tmp_path / "first" / "L", tmp_path / "second" / "L"])
    for libraries, found in ((both, True), (Libraries(both.places[:1]), False), (Libraries(both.places[1:]), True)):
        assert libraries.full("L.X") is not None
        assert (libraries.full("L.X.Y") is not None) is found
        assert libraries.full("L.X.Z") is None


def test_a_class_that_is_not_there_is_said_with_what_is_near(library: Path, tmp_path: Path) -> None:
    with pytest.raises(TextError, match=r"package\.mo: class Lib\.Subb is not here: there is no Subb; near it: Sub"):
        Libraries([library]).find("Lib.Subb")
    with pytest.raises(TextError, match=r"class Else is not in .*; give its full name"):
        Libraries([library]).find("Else")
    renamed = library.rename(tmp_path / "Lib 1.0")
    with pytest.raises(TextError, match="rename the folder to Lib"):
        Libraries([renamed]).find("Lib.Base")
    with pytest.raises(TextError, match="rename the folder to Lib"):
        list(Libraries([renamed]).classes())


def test_a_class_behind_a_syntax_error_is_still_placed(tmp_path: Path) -> None:
    file = tmp_path / "M.mo"
    file.write_text("end ;\n\nmodel M\n  Real x\nend M;\n")
    found = Libraries([file]).find("M")
    assert (found.kind, found.place(found.start)) == ("model", (file, 3))


def test_a_file_that_changes_is_read_again(tmp_path: Path) -> None:
    file = tmp_path / "M.mo"
    for name in ("Aa", "Bb", "Aa"):
        file.write_text(f"model {name} end {name};")
        assert [one.full_name for one in Libraries([file]).classes()] == [name]


def test_what_is_no_library_is_refused(tmp_path: Path) -> None:
    text = tmp_path / "M.txt"
    text.write_text("model M end M;")
    for place in (tmp_path, text):
        with pytest.raises(
            TextError, match=r"is no Modelica library; give a folder with a package\.mo, or a \.mo file"
        ):
            Libraries([place]).find("M")
    with pytest.raises(TextError, match="does not exist"):
        Libraries([tmp_path / "x.mo"]).find("M")
