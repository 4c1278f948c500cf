"""A class that is written is read again with the same parts."""

from pathlib import Path

from fmu_build.text import class_text
from fmu_build.text.classes import read_classes
from fmu_build.text.declarations import Kind, Source


def test_what_is_written_is_what_is_read() -> None:
    inner = class_text("Inner", kind="partial model", declarations=["Real y"])
    text = class_text(
        "M", description='a "law"\\', comment="Made by us.\n\nTwice.", classes=[inner],
        extends=[("Lib.Base", ["a=1", "redeclare Lib.B part"])],
        declarations=['parameter Real F(unit="N") = 0 "Force"'],
        equations=["f = F*u", "y = 1"], annotation='__V(effect="e")',
    )  # fmt: skip
    assert text.startswith("// Made by us.\n//\n// Twice.\nmodel M ")
    model = read_classes(Source(Path("M.mo"), text))["M"]
    assert model.description == 'a "law"\\'
    assert (model.classes["Inner"].kind, model.classes["Inner"].prefixes) == ("model", {"partial"})
    base, force = (next(model.of_kind(kind)) for kind in (Kind.EXTENDS, Kind.COMPONENT))
    assert (base.class_name, base.text(base.arguments)) == ("Lib.Base", "a=1,\n    redeclare Lib.B part")
    assert (force.name, force.description) == ("F", "Force")
    assert [model.text(one.tokens) for one in model.equations] == ["f = F*u;", "y = 1;"]
    assert model.text(model.annotation) == '__V(effect="e")'
