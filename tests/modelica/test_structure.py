"""Every file of the library: in its place, in its package's order, documented, and good Modelica by itself."""

import re
from pathlib import Path

import pytest
import rumoca

from tests.modelica.declared import without_description
from tests.modelica.library import FILES, FOLDERS, LIBRARY, class_name

ALL_FILES = pytest.mark.parametrize("file", FILES, ids=class_name)
HOLD_COMPONENTS = {"Effects", "Fluids", "Functions", "Hydraulics", "Mechanics", "Pump", "Sources"}
HOLD_COMPONENTS |= {"Controllers", "Crane", "LoadCircuit"}
COMPONENTS = [file for file in FILES if file.parent.name in HOLD_COMPONENTS]


def read(file: Path) -> str:
    return file.read_text(encoding="utf-8")


def without_texts(source: str) -> str:
    """The source without strings and comments."""
    return re.sub(r'"(?:\\.|[^"\\])*"|//[^\n]*', "", source)


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_package_order_names_each_class_once(folder: Path) -> None:
    ordered = (folder / "package.order").read_text(encoding="utf-8").split()
    classes = {path.stem for path in folder.glob("*.mo")} - {"package"}
    classes |= {path.parent.name for path in folder.glob("*/package.mo")}
    constants = set(re.findall(r"^  constant \w+ (\w+)", read(folder / "package.mo"), re.MULTILINE))
    assert len(ordered) == len(set(ordered))
    assert set(ordered) == classes | constants


def test_every_folder_is_a_package() -> None:
    assert {path.parent for path in FILES} == set(FOLDERS)


@ALL_FILES
def test_file_holds_the_class_of_its_place(file: Path) -> None:
    *outer, name = class_name(file).split(".")
    source = read(file)
    assert source.startswith(f"within {'.'.join(outer)};\n")
    assert re.search(rf"^(partial )?(\w+) {name}\b", source, re.MULTILINE)
    assert re.search(rf"^end {name};$|^(type|connector) {name} = ", source, re.MULTILINE)


@ALL_FILES
def test_rumoca_parses_the_file_alone(file: Path) -> None:
    assert [found.message for found in rumoca.validate(str(file)) if found.rule == "syntax-error"] == []


@ALL_FILES
def test_class_is_described_and_names_its_source(file: Path) -> None:
    source = read(file)
    name = class_name(file).split(".")[-1]
    documentation = re.search(r'Documentation\(info="((?:\\.|[^"\\])*)"', source)
    assert re.search(rf'(\w+) {name}( = [^"]*)?\s+"[^"]+"', source) or re.search(r'\) "[^"]+"\n  annotation', source)
    assert documentation
    text = documentation[1].strip()
    assert text.startswith("<html>")
    assert text.endswith("</html>")
    assert "<b>Source:</b>" in text


@pytest.mark.parametrize("file", [file for file in COMPONENTS if file.stem != "package"], ids=class_name)
def test_component_says_its_limits(file: Path) -> None:
    assert re.search(r"<b>Valid[:,]|<b>Leaves out:", read(file))


@ALL_FILES
def test_every_declaration_is_described(file: Path) -> None:
    assert without_description(file, read(file)) == []


def test_a_silent_declaration_is_seen() -> None:
    text = """model M "Text"
  extends Icons.Component;
  parameter Real a = f("no description", 1) "Described";
  parameter Real b = f("no description", 1) annotation(Dialog(group="x"));
  Real c, d(start=1) "Both"; // "comment"
protected
  Volume e(V=1e-3);
initial equation
  x = 0;
equation
  y = "z";
end M;
"""
    assert without_description(Path("M.mo"), text) == [
        "parameter Real b = f ( ) annotation ( )",
        "protected Volume e ( )",
    ]


DECLARED = re.compile(r"^  (replaceable )?((?:[A-Z]\w*\.)*[A-Z]\w*) (\w+)(?=[\s(\[])([^;]*);", re.MULTILINE)
NO_PARTS = {"Real", "Integer", "Boolean", "Types", "Data"}
OFFERS = {"Crane", "Examples", "Hydraulics", "LoadCircuit", "Pairs", "Pump"}


def parts_of(file: Path) -> list[tuple[bool, str, str]]:
    """(replaceable, name, the rest of its declaration) of each component that is no variable and no record."""
    found = DECLARED.findall(without_texts(read(file)))
    return [(bool(slot), name, rest) for slot, kind, name, rest in found if kind.split(".")[0] not in NO_PARTS]


@pytest.mark.parametrize("file", [file for file in COMPONENTS if file.parent.name != "Pairs"], ids=class_name)
def test_each_part_has_a_place_of_its_own_in_the_diagram(file: Path) -> None:
    places = {name: re.search(r"Placement\(transformation\(([^)]*)", rest) for _, name, rest in parts_of(file)}
    assert [name for name, place in places.items() if not place] == []
    drawn = [place[1] for place in places.values() if place]
    assert len(set(drawn)) == len(drawn)


@pytest.mark.parametrize("file", [file for file in FILES if file.parent.name in OFFERS], ids=class_name)
def test_slot_offers_what_fits(file: Path) -> None:
    """A dialog lists the classes that a slot takes."""
    assert [name for slot, name, rest in parts_of(file) if slot and "choicesAllMatching=true" not in rest] == []


@ALL_FILES
def test_lines_fit_the_page(file: Path) -> None:
    long = [n for n, line in enumerate(read(file).splitlines(), 1) if len(line) > 120]
    assert long == []


@ALL_FILES
def test_library_needs_no_other(file: Path) -> None:
    assert not re.search(r"\bModelica\.", without_texts(read(file)))


def test_connectors_agree_with_the_standard_library() -> None:
    """Variables, prefixes and order of Flange_a of Modelica.Mechanics.Rotational and .Translational."""
    for name in ("Flange_a", "Flange_b"):
        source = without_texts(read(LIBRARY / "Interfaces" / f"{name}.mo"))
        assert re.findall(r"^  (flow )?Types\.(\w+) (\w+)", source, re.MULTILINE) == [
            ("", "Angle", "phi"),
            ("flow ", "Torque", "tau"),
        ]
    for name in ("TranslationFlange_a", "TranslationFlange_b"):
        source = without_texts(read(LIBRARY / "Interfaces" / f"{name}.mo"))
        assert re.findall(r"^  (flow )?Types\.(\w+) (\w+)", source, re.MULTILINE) == [
            ("", "Length", "s"),
            ("flow ", "Force", "f"),
        ]
