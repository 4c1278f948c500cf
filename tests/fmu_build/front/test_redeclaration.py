"""Redeclarations the compiler would drop are refused; those it follows change the model."""

from pathlib import Path

import pytest

from fmu_build.errors import BuildError
from fmu_build.front import load

LIBRARY = """
package L
  partial model Slot input Real x; output Real f; end Slot;
  model Nothing extends Slot; equation f = 0; end Nothing;
  model Spring extends Slot; parameter Real k = 2; equation f = -k*x; end Spring;
  model Cart
    replaceable Nothing slot constrainedby Slot;
    replaceable model Part = Nothing constrainedby Slot;
    Part part;
    Real x(start = 1, fixed = true);
  equation
    slot.x = x; part.x = x; der(x) = slot.f + part.f;
  end Cart;
  model Heavy extends Cart; end Heavy;
  model Train Heavy cart; end Train;
  %s
end L;
"""


def parameters(model: str, folder: Path) -> set[str]:
    file = folder / "L.mo"
    file.write_text(LIBRARY % model, encoding="utf-8")
    flat = load("L.M", [file])
    return {variable.name for variable in flat.variables if variable.name.endswith(".k")}


@pytest.mark.parametrize(
    ("model", "expected"),
    [
        ("model M extends Cart(redeclare Spring slot); end M;", "slot.k"),
        ("model M extends Cart(redeclare Spring slot(k = 5)); end M;", "slot.k"),
        ("model M extends Heavy(redeclare model Part = Spring); end M;", "part.k"),
        ("model M Heavy a(redeclare Spring slot); end M;", "a.slot.k"),
    ],
)
def test_followed(model: str, expected: str, tmp_path: Path) -> None:
    assert parameters(model, tmp_path) == {expected}


@pytest.mark.parametrize(
    ("model", "message"),
    [
        ("model M extends Heavy(redeclare Spring slot); end M;", "extend L.Cart instead"),
        ("model M = Heavy(redeclare Spring slot);", "extend L.Cart instead"),
        ("model N extends Heavy(redeclare Spring slot); end N; model M N n; end M;", "extend L.Cart instead"),
        ("model M extends Train(cart(redeclare Spring slot)); end M;", "inside a part of another part"),
        ("model M extends Cart(redeclare Spring brake); end M;", "no replaceable part brake"),
        ("model M extends Cart(redeclare model Brake = Spring); end M;", "no replaceable part Brake"),
    ],
)
def test_refused(model: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(BuildError, match=message) as caught:
        parameters(model, tmp_path)
    assert caught.value.line is not None
