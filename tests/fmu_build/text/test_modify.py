"""Values in modifications: beside what is there, in place of it, and inside of parts."""

import pytest

from fmu_build.text import TextError, with_values


@pytest.mark.parametrize(
    ("modifications", "values", "expected"),
    [
        ([], {"m": 2.0}, ["m=2.0"]),
        (["data=D.Free()"], {"m": 1e-8}, ["data=D.Free()", "m=1e-08"]),
        (["m=1 + x"], {"m": 2.0}, ["m=2.0"]),
        (["final k(min=0, max=a*(b + c))=3"], {"k": -4.5}, ["final k(min=0, max=a*(b + c))=-4.5"]),
        (["s(k=1, each d(min=0)=2)"], {"s.d": 5.0, "s.e": 6.0}, ["s(k=1, each d(min=0)=5.0, e=6.0)"]),
        (["redeclare A.B slot"], {"slot.F": 0.4}, ["redeclare A.B slot(F=0.4)"]),
        (["redeclare replaceable B slot(F=1)"], {"slot.F": 0.4}, ["redeclare replaceable B slot(F=0.4)"]),
        (["redeclare P s"], {"s.first.F": 1.0, "s.second.G": 2.0}, ["redeclare P s(first(F=1.0), second(G=2.0))"]),
    ],
)  # fmt: skip
def test_values_go_where_they_belong(modifications: list[str], values: dict[str, float], expected: list[str]) -> None:
    assert with_values(modifications, values) == expected


def test_the_elements_of_an_array_are_one_value() -> None:
    values = {"s.c[2]": 2.0, "s.c[1]": 1.0, "s.k": 3.0}
    assert with_values(["redeclare A s(c=zeros(2))"], values) == ["redeclare A s(c={1.0, 2.0}, k=3.0)"]


@pytest.mark.parametrize("values", [{"c[1]": 1.0, "c[3]": 1.0}, {"c[0]": 1.0}, {"p[1].c": 1.0}, {"a": 1.0, "a.b": 2.0}])
def test_what_modelica_cannot_set_is_refused(values: dict[str, float]) -> None:
    with pytest.raises(TextError):
        with_values([], values)
