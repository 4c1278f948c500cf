"""Every file of both libraries: in its place, in its package's order, documented, and good Modelica by itself.

Each test looks at all files at once and names those that offend.
"""

import re
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path

from tests.modelica.declared import without_description
from tests.modelica.library import LIBRARY, class_name

LIBRARIES = (LIBRARY, LIBRARY.parent / "HydraulicTestBenchMSL")
FILES = sorted(file for library in LIBRARIES for file in library.rglob("*.mo"))
FOLDERS = sorted(file.parent for library in LIBRARIES for file in library.rglob("package.mo"))
HOLD_COMPONENTS = {"Effects", "Fluids", "Functions", "Hydraulics", "Mechanics", "Pump", "Sources"}
HOLD_COMPONENTS |= {"Controllers", "Crane", "LoadCircuit"}
COMPONENTS = [file for file in FILES if file.parent.name in HOLD_COMPONENTS]
OFFERS = {"Crane", "Examples", "Hydraulics", "LoadCircuit", "Pairs", "Pump"}


@cache
def read(file: Path) -> str:
    return file.read_text(encoding="utf-8")


@cache
def without_texts(file: Path) -> str:
    """The source without strings and comments."""
    return re.sub(r'"(?:\\.|[^"\\])*"|//[^\n]*', "", read(file))


def offending(holds: Callable[[Path], object], files: Sequence[Path] = FILES) -> list[str]:
    """Names of the classes whose file does not hold what it should."""
    assert files
    return [class_name(file) for file in files if not holds(file)]


def found_in(search: Callable[[Path], list[str]], files: Sequence[Path] = FILES) -> dict[str, list[str]]:
    """Class -> what was found in its file, where anything was."""
    assert files
    return {class_name(file): found for file in files if (found := search(file))}


def test_package_order_names_each_class_once() -> None:
    wrong = {}
    for folder in FOLDERS:
        ordered = (folder / "package.order").read_text(encoding="utf-8").split()
        classes = [path.stem for path in folder.glob("*.mo") if path.stem != "package"]
        classes += [path.parent.name for path in folder.glob("*/package.mo")]
        classes += re.findall(r"^  constant \w+ (\w+)", read(folder / "package.mo"), re.MULTILINE)
        if sorted(ordered) != sorted(classes):
            wrong[folder.name] = set(ordered) ^ set(classes) or "named twice"
    assert wrong == {}


def test_every_folder_is_a_package() -> None:
    assert {path.parent for path in FILES} == set(FOLDERS)


def test_file_holds_the_class_of_its_place() -> None:
    def holds(file: Path) -> object:
        *outer, name = class_name(file).split(".")
        begins = re.search(rf"^(partial )?(\w+) {name}\b", read(file), re.MULTILINE)
        ends = re.search(rf"^end {name};$|^(type|connector) {name} = ", read(file), re.MULTILINE)
        return read(file).startswith(f"within {'.'.join(outer)};\n") and begins and ends

    assert offending(holds) == []


def test_rumoca_parses_each_file_alone() -> None:
    import rumoca

    def errors(file: Path) -> list[str]:
        return [found.message for found in rumoca.validate(str(file)) if found.rule == "syntax-error"]

    assert found_in(errors) == {}


def test_class_is_described_and_names_its_source() -> None:
    def holds(file: Path) -> object:
        source, name = read(file), class_name(file).split(".")[-1]
        documentation = re.search(r'Documentation\(info="((?:\\.|[^"\\])*)"', source)
        text = documentation[1].strip() if documentation else ""
        described = re.search(rf'(\w+) {name}( = [^"]*)?\s+"[^"]+"', source)
        described = described or re.search(r'\) "[^"]+"\n  annotation', source)
        return described and text.startswith("<html>") and text.endswith("</html>") and "<b>Source:</b>" in text

    assert offending(holds) == []


def test_component_says_its_limits() -> None:
    parts = [file for file in COMPONENTS if file.stem != "package"]
    assert offending(lambda file: re.search(r"<b>Valid[:,]|<b>Leaves out:", read(file)), parts) == []


def test_every_declaration_is_described() -> None:
    assert found_in(lambda file: without_description(file, read(file))) == {}


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


def parts_of(file: Path) -> list[tuple[bool, str, str]]:
    """(replaceable, name, the rest of its declaration) of each component that is no variable and no record."""
    found = DECLARED.findall(without_texts(file))
    return [(bool(slot), name, rest) for slot, kind, name, rest in found if kind.split(".")[0] not in NO_PARTS]


def test_each_part_has_a_place_of_its_own_in_the_diagram() -> None:
    def misplaced(file: Path) -> list[str]:
        places = {name: re.search(r"Placement\(transformation\(([^)]*)", rest) for _, name, rest in parts_of(file)}
        drawn = [place[1] if place else "" for place in places.values()]
        return [name for name, at in zip(places, drawn, strict=True) if not at or drawn.count(at) > 1]

    assert found_in(misplaced, [file for file in COMPONENTS if file.parent.name != "Pairs"]) == {}


def test_slot_offers_what_fits() -> None:
    """A dialog lists the classes that a slot takes."""

    def silent(file: Path) -> list[str]:
        return [name for slot, name, rest in parts_of(file) if slot and "choicesAllMatching=true" not in rest]

    assert found_in(silent, [file for file in FILES if file.parent.name in OFFERS]) == {}


def test_lines_fit_the_page() -> None:
    def long(file: Path) -> list[str]:
        return [line for line in read(file).splitlines() if len(line) > 120]

    assert found_in(long) == {}


def test_library_needs_no_other() -> None:
    own = [file for file in FILES if LIBRARY in file.parents]
    assert offending(lambda file: not re.search(r"\bModelica\.", without_texts(file)), own) == []


def test_connectors_agree_with_the_standard_library() -> None:
    """Variables, prefixes and order of Flange_a of Modelica.Mechanics.Rotational and .Translational."""
    wanted = {
        "Flange": [("", "Angle", "phi"), ("flow ", "Torque", "tau")],
        "TranslationFlange": [("", "Length", "s"), ("flow ", "Force", "f")],
    }
    for kind, variables in wanted.items():
        for end in "ab":
            source = without_texts(LIBRARY / "Interfaces" / f"{kind}_{end}.mo")
            assert re.findall(r"^  (flow )?Types\.(\w+) (\w+)", source, re.MULTILINE) == variables
