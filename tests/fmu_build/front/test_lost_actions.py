"""Assertions and when-clauses in if-equations are kept where the condition is decided, and refused elsewhere."""

from pathlib import Path

import pytest

from fmu_build.errors import BuildError
from fmu_build.front import load
from fmu_build.front.flat_model import FlatModel

TEXT = """\
package P
  model Base
    parameter Boolean s = true;
    parameter Integer k = 1;
    Integer n(start = 0, fixed = true);
    Real x(start = 1, fixed = true);
    Real y;
  equation
    der(x) = -x;
  end Base;
  model Part
    extends Base;
    {declarations}
  equation
    {equations}
  end Part;
  model Other parameter Boolean s = false; Real z = if s then 1 else 2; end Other;
  model M {model} end M;
end P;
"""
IF_LINE = 15
EARLY, LATE = 'assert(time < 0.2, "early");', 'assert(time < 0.5, "late");'
ONCE, TWICE = "when time > 0.5 then n = 1; end when;", "when time > 0.2 then n = 2; end when;"
EITHER = f"if s then {EARLY} else {LATE} end if; y = 1; n = 1;"
STOP = "when x < 0.5 then reinit(x, 1); end when;"


def compiled(folder: Path, equations: str, declarations: str = "", model: str = "extends Part;") -> FlatModel:
    file = folder / "P.mo"
    lines = equations.replace("then ", "then\n").replace("else ", "else\n")
    file.write_text(TEXT.format(equations=lines, declarations=declarations, model=model), encoding="utf-8")
    return load("P.M", [file])


@pytest.mark.parametrize(
    ("equations", "lost"),
    [
        (f"if s then {ONCE} else {TWICE} end if; y = 1;", "when .*make s final"),
        (f"if k == 2 then {ONCE} else {TWICE} end if; y = 1;", "when .*make k final"),
        (f"if false then {ONCE} elseif s then {TWICE} else {ONCE} end if; y = 1;", "when .*make s final"),
        (f"if s then {STOP} else {STOP} end if; y = 1; n = 1;", "when"),
        (f"if s then {EARLY} y = 1; else {LATE} y = 2; end if; n = 1;", "assert"),
        ('if s then terminate("a"); else terminate("b"); end if; y = 1; n = 1;', "terminate"),
        (f"for i in 1:2 loop if s then {EARLY} end if; end for; y = 1; n = 1;", "assert .*make s final"),
        (f"if x > 0.5 then {EARLY} end if; y = 1; n = 1;", "assert .*as part of its own$"),
        (f"if s and x > 0.5 then {EARLY} end if; y = 1; n = 1;", "assert"),
        (f"if time > 0.5 then {EARLY} end if; y = 1; n = 1;", "assert"),
        (f"if size({{1, 2}}, 1) == 2 then {EARLY} else {LATE} end if; y = 1; n = 1;", "assert"),
        (f"initial equation if s then {EARLY} else {LATE} end if; equation y = 1; n = 1;", "assert"),
    ],
)
def test_what_would_be_lost_is_refused(equations: str, lost: str, tmp_path: Path) -> None:
    with pytest.raises(BuildError, match=rf"drop the {lost}") as caught:
        compiled(tmp_path, equations)
    assert (caught.value.file, caught.value.line) == (tmp_path / "P.mo", IF_LINE)


def test_one_part_of_several_is_enough(tmp_path: Path) -> None:
    with pytest.raises(BuildError, match="drop the assert"):
        compiled(
            tmp_path, f"if s then {EARLY} else {LATE} end if; y = 1; n = 1;", model="Part a(final s = true); Part b;"
        )


@pytest.mark.parametrize(
    ("equations", "declarations", "asserts", "clauses"),
    [
        (f"if s then {ONCE} end if; y = 1; {LATE}", "", 1, 1),
        (f"if s then {EARLY} y = 1; else y = 2; end if; n = 1;", "", 1, 0),
        (f"if not s then {EARLY} y = 1; else y = 2; end if; n = 1;", "", 0, 0),
        (f"if f then {EARLY} {ONCE} else {LATE} {TWICE} end if; y = 1;", "final parameter Boolean f = true;", 1, 1),
        (f"if f then {EARLY} else {LATE} end if; y = 1; n = 1;",
         "parameter Boolean f = true annotation(Evaluate = true);", 1, 0),
        (f"if f then if g then {EARLY} else {LATE} end if; end if; y = 1; n = 1;",
         "constant Boolean f = false; constant Boolean g = true;", 0, 0),
        (f"for i in 1:3 loop if i > 1 then {EARLY} else {LATE} end if; end for; y = 1; n = 1;",
         "Real i = time;", 3, 0),
        ("if s then y = 1; else y = 2; end if; n = 1;", "", 0, 0),
    ],
)  # fmt: skip
def test_what_is_kept_is_taken(equations: str, declarations: str, asserts: int, clauses: int, tmp_path: Path) -> None:
    model = compiled(tmp_path, equations, declarations)
    assert (len(model.assertions), len(model.clauses)) == (asserts, clauses)


def test_a_parameter_of_the_same_name_elsewhere_does_not_matter(tmp_path: Path) -> None:
    model = "Part part(final s = true); Other other;"
    assert len(compiled(tmp_path, EITHER, model=model).assertions) == 1


def test_one_of_the_same_name_in_the_model_itself_confuses_the_compiler(tmp_path: Path) -> None:
    with pytest.raises(BuildError, match="drop the assert"):
        compiled(tmp_path, EITHER, model="Part part(final s = true); parameter Boolean s = false;")
