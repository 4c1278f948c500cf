"""Indices and iterators of which the compiler would mix up the dimensions are refused; all others are right."""

import pytest

from fmu_build.errors import BuildError
from fmu_build.lower import OdeModel
from tests.fmu_build.lower.compiling import compiled
from tests.fmu_build.lower.reference_runner import Runner

TEXT = """
package P
  record R Real a[2]; Integer n; end R;
  connector C Real p; flow Real f; end C;
  model S C c; equation c.p = 2; end S;
  model Q C c[2]; equation c[1].f = c[1].p; c[2].f = 10*c[2].p; end Q;
  function f input R r[2]; output Real y[2]; algorithm y := r.a[1]; end f;
  model Base R r[2](a = {{1, 2}, {3, 4}}, n = {5, 6}); parameter Integer k[2] = {2, 1}; end Base;
  model M extends Base; Base x; Q q[2]; S s[2]; Real y[2];
  equation
    __;
  end M;
end P;
"""
CONNECTED = "for i in 1:2 loop connect(s[i].c, q[i].c[1]); end for"


def model(equations: str) -> OdeModel:
    return compiled(TEXT.replace("__", equations), "P.M")


@pytest.mark.parametrize(
    "equations",
    [
        "y = r.a[1]",
        "y = r[:].a[1]",
        "y = r[2:-1:1].a[1]",
        "y = r[{2, 1}].a[1]",
        "y = r[k].a[1]",
        "y = x.r.a[2]",
        "y = x.r[1:2].a[2]",
        "r.a[2] = y",
        "y = {1, 2}; connect(s.c, q.c[1])",
        "y = {1, 2}; connect(s.c, q[:].c[1])",
    ],
)
def test_an_index_behind_an_array_of_parts_is_refused(equations: str) -> None:
    with pytest.raises(BuildError, match="wrong elements") as caught:
        model(equations)
    assert caught.value.line == TEXT[: TEXT.index("__")].count("\n") + 1


def test_so_is_one_in_a_function() -> None:
    with pytest.raises(BuildError, match="wrong elements") as caught:
        model(f"y = f(r); {CONNECTED}")
    assert caught.value.line == TEXT[: TEXT.index(":= r.a[1]")].count("\n") + 1


@pytest.mark.parametrize(
    "value", ["{i + 10*j for j in 1:2, i in 1:2}*{1, 0}", "f(r) + {sum({i*j, 1}) for j in 1:2, i in 1:1}"]
)
def test_several_iterators_in_an_array_are_refused(value: str) -> None:
    with pytest.raises(BuildError, match="nest them"):
        model(f"y = {value}; {CONNECTED}")


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        ("{r[i].a[1] for i in 1:2}", [1, 3]),
        ("r[2].a", [3, 4]),
        ("r[k[1]].a[:]", [3, 4]),
        ("r[2:-1:1].n", [6, 5]),
        ("{{i + 10*j for j in 1:2} for i in 1:2}*{1, 0}", [11, 12]),
        ("{sum(i*j for i in 1:2, j in 1:3), sum({i, 3}*{1, 2} for i in 1:2)}", [18, 15]),
        ("{r[1].n, x.r[2].a[1]}", [5, 3]),
    ],
)
def test_other_indices_take_what_they_mean(value: str, expected: list[float]) -> None:
    run = Runner(model(f"y = {value}; {CONNECTED}"))
    assert [run.at("y[1]"), run.at("y[2]")] == expected
    assert [run.at("q[1].c[1].f"), run.at("q[2].c[1].f"), run.at("q[2].c[2].f")] == [2, 2, 0]
