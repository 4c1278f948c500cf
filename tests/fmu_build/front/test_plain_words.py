"""What the compiler refuses in words of its own is said in ours, with the cure."""

import re
from pathlib import Path

import pytest

from fmu_build.errors import BuildError
from fmu_build.front import load

DISCRETE = "Integer n(start = 0, fixed = true); Integer m(start = 0, fixed = true);"
COUNTS = "n = pre(n) + 1; end when;"


def refused(folder: Path, text: str) -> BuildError:
    file = folder / "M.mo"
    file.write_text(f"model M\n{text}\nend M;", encoding="utf-8")
    with pytest.raises(BuildError) as caught:
        load("M", [file])
    assert caught.value.file == file
    return caught.value


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("Real x = time; Integer i; equation i = x;",
         r"types or sizes do not agree in this model \(the line is its first\)"),
        ("Real x; Real y[2] = fill(time, 2); equation x = y*{1, 2, 3};", "types or sizes do not agree"),
        ("Real y = sum(cross({1, 0, 0}, {0, 1, 0}))*time;", r"write 1\.0 instead of 1"),
        ("Real y = delay(time, 1);", r"write 1\.0 instead of 1"),
        ("type E = enumeration(a, b); E e = if time > 1 then E.a else E.b; Integer i; equation i = Integer(e);",
         r"Integer\(e\) is not supported, compare e"),
        (f"input Boolean u; {DISCRETE} equation m = 1; when edge(u) then {COUNTS}",
         r"Boolean inside = u.*edge\(inside\)"),
        (f"input Integer u; {DISCRETE} equation m = 1; when change(u) then {COUNTS}", r"change\(inside\)"),
        (f"input Boolean u; {DISCRETE} equation m = 1; when time > 1 and pre(u) then {COUNTS}",
         r"pre\(\) of the input u .*Boolean inside = u"),
        ("Integer n[2](each start = 0); equation for i in 1:2 loop when time > i then n[i] = 1; end when; end for;",
         r"single element n\[1\].*set all of n"),
        ("Real x[2](each start = 0); equation der(x) = {1, 1}; when x[2] > 1 then reinit(x[2], 0); end when;",
         r"single element x\[2\].*reinit\(x, \{\.\.\.\}\)"),
        ("Real y; Real z; algorithm y := time; z := 2*y;", "only one continuous variable.*algorithm section for each"),
        ("Real y; algorithm y := 0; for i in 1:3 loop y := y + i*time; end for;", "only one continuous variable"),
        ("function f input Real x; output Real y; algorithm y := 0; for i in {1, 3} loop y := y + i*x; end for; end f; "
         "Real z = f(time);", "loop in function f .* for i in 1:2:5"),
        (f"Real x = time; {DISCRETE} algorithm when sample(0, 0.1) then n := pre(n) + 1; "
         "if n > 3 then n := 0; m := 1; end if; end when;", "write equations: variable = if"),
    ],
)  # fmt: skip
def test_said_in_plain_words(text: str, said: str, tmp_path: Path) -> None:
    assert re.search(said, refused(tmp_path, text).message)


@pytest.mark.parametrize(
    ("body", "line", "said"),
    [
        ("if x > 1 then\n  y := 1;\nelseif x > 0 then\n  y := 2;\nend if;", 2, "without a value .* on every path"),
        ('y := x;\nassert(x < 1, "a");', 7, "assert in a function is not supported"),
    ],
)
def test_assertions_in_functions_are_told_from_missing_values(body: str, line: int, said: str, tmp_path: Path) -> None:
    text = f"function f\n  input Real x;\n  output Real y;\nalgorithm\n{body}\nend f;\nReal z = f(time);"
    error = refused(tmp_path, text)
    assert re.search(said, error.message)
    assert error.line == line


@pytest.mark.parametrize(
    "text",
    [
        f"input Boolean u; Boolean inside = u; {DISCRETE} equation m = 1; when edge(inside) then {COUNTS}",
        "Real y; Real z; algorithm y := time; algorithm z := 2*y;",
        "Real x[2](each start = 0); equation der(x) = {1, 1}; when x[2] > 1 then reinit(x, {0, 0}); end when;",
        "Real y = delay(time, 1.0);",
    ],
)
def test_the_cures_are_ones(text: str, tmp_path: Path) -> None:
    file = tmp_path / "M.mo"
    file.write_text(f"model M\n{text}\nend M;", encoding="utf-8")
    assert load("M", [file]).name == "M"
