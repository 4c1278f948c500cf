"""A package that changes a constant of another: right where it is taken, refused where two would be mixed up."""

import pytest

from fmu_build.errors import BuildError
from tests.fmu_build.lower.compiling import compiled
from tests.fmu_build.lower.reference_runner import Runner

LIBRARY = """
package L
  package Oil constant Real rho = 1000; constant Real cp = 2;
    function density input Real T; output Real d; algorithm d := rho*(1 - T); end density;
    model State Real y = rho; end State;
  end Oil;
  package Water extends Oil(final rho = 800); end Water;
  package Brine = Oil(rho = 700);
  package Cold extends Water(rho = 600); end Cold;
  package Own extends Oil(rho = 500);
    redeclare function density input Real T; output Real d; algorithm d := rho*(2 - T); end density;
  end Own;
  model Tank replaceable package Medium = L.Oil; Real r = Medium.rho; end Tank;
  model Other extends Tank; end Other;
  model Pipe replaceable package Medium = Oil; Real r = Medium.rho; Real d = Medium.density(0.5); end Pipe;
  model Line replaceable package Medium = Oil;
    Pipe a(redeclare package Medium = Medium); Tank b(redeclare package Medium = Medium); end Line;
  function dense output Real d; algorithm d := Oil.rho; end dense;
  %s
end L;
"""
OWN_LINE = LIBRARY[: LIBRARY.index("%s")].count("\n")  # compiled() begins behind the first line break
OTHER_TOO = "would change it in L.Oil too"
INHERITED = "may leave L.Oil.density, which L.Water inherits"


def values(model: str) -> dict[str, float]:
    """All variables of L.M."""
    built = compiled((LIBRARY % model).lstrip("\n"), "L.M")
    run = Runner(built)
    return {variable.name: run.at(variable.name) for variable in built.variables if variable.name != "time"}


@pytest.mark.parametrize(
    ("model", "expected"),
    [
        ("model M Tank p, q; end M;", {"p.r": 1000, "q.r": 1000}),
        ("model M Tank p(redeclare package Medium = Water); end M;", {"p.r": 800}),
        ("model M Pipe p(redeclare package Medium = L.Water); end M;", {"p.r": 800, "p.d": 400}),
        ("model M Pipe p(redeclare package Medium = Water); Pipe q(redeclare package Medium = Brine); end M;",
         {"p.r": 800, "p.d": 400, "q.r": 700, "q.d": 350}),
        ("model M Line l(redeclare package Medium = Water); end M;", {"l.a.r": 800, "l.a.d": 400, "l.b.r": 800}),
        ("model M replaceable package Medium = Water; Line l(redeclare package Medium = Medium); end M;",
         {"l.a.r": 800, "l.a.d": 400, "l.b.r": 800}),
        ("model M replaceable package Medium = Water; Medium.State s; Real d = Medium.density(0.5); end M;",
         {"s.y": 800, "d": 400}),
        ("model M extends Tank(redeclare package Medium = Own); end M;", {"r": 500}),
        ("model M extends Pipe(redeclare package Medium = Own); end M;", {"r": 500, "d": 750}),
        ("model M Real a = Water.rho; Real b = Brine.rho; end M;", {"a": 800, "b": 700}),
    ],
)  # fmt: skip
def test_right(model: str, expected: dict[str, float]) -> None:
    assert values(model) == expected


@pytest.mark.parametrize(
    ("model", "message"),
    [
        ("model M Tank p(redeclare package Medium = Water); Tank q; end M;", OTHER_TOO),
        ("model M Tank q; Tank p(redeclare package Medium = Water); end M;", OTHER_TOO),
        ("model M Tank p(redeclare package Medium = Water), q(redeclare package Medium = Oil); end M;", OTHER_TOO),
        ("model M Tank p(redeclare package Medium = Water); Other q; end M;", OTHER_TOO),
        ("model M extends Tank(redeclare package Medium = Own); Other q; end M;", OTHER_TOO),
        ("model M extends Tank; redeclare package Medium = Own; Other q; end M;", OTHER_TOO),
        ("model M Line l(redeclare package Medium = Water); Tank q; end M;", OTHER_TOO),
        ("model M Tank p(redeclare package Medium = Water); Real y = Oil.rho; end M;", OTHER_TOO),
        ("model M Tank p(redeclare package Medium = Water); Real y = dense(); end M;", OTHER_TOO),
        ("model M Real a = Oil.rho; Real b = Brine.rho; end M;", OTHER_TOO),
        ("model M Real a = Cold.rho; end M;", "rho of L.Cold is changed twice"),
        ("model M Tank p(redeclare package Medium = Cold); end M;", "rho of L.Cold is changed twice"),
        ("model M extends Pipe(redeclare package Medium = Water); end M;", INHERITED),
        ("model M extends Pipe; redeclare package Medium = Water; end M;", INHERITED),
        ("model N = Pipe(redeclare package Medium = Water); model M extends N; end M;", INHERITED),
    ],
)
def test_refused(model: str, message: str) -> None:
    with pytest.raises(BuildError, match=message) as caught:
        values(model)
    assert caught.value.line == OWN_LINE


def test_the_cure_that_is_named_helps() -> None:
    model = """
      partial package Fluid constant Real rho; end Fluid;
      package Heavy extends Fluid(rho = 9); end Heavy; package Light extends Fluid(rho = 1); end Light;
      model Jar replaceable package Medium = Heavy constrainedby Fluid; Real r = Medium.rho; end Jar;
      model M Jar p(redeclare package Medium = Light); Jar q; end M;"""
    assert values(model) == {"p.r": 1, "q.r": 9}
