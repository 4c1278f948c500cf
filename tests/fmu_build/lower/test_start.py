"""Start values where the model is silent."""

import pytest

from tests.fmu_build.lower.compiling import compiled

ENUMERATION = """
package P
  type Mode = enumeration(idle, busy, done);
  model M input Mode u%s; discrete Mode d%s; Integer n; equation
    n = if u == Mode.idle then 1 else 2;
    when time > 1 then d = Mode.busy; end when;
  end M;
end P;"""


@pytest.mark.parametrize(
    ("attributes", "expected"),
    [("", 1), ("(min = Mode.busy)", 2), ("(start = Mode.done)", 3), ("(max = Mode.busy)", 1)],
)
def test_an_enumeration_starts_at_a_literal(attributes: str, expected: float) -> None:
    model = compiled(ENUMERATION % (attributes, attributes), "P.M")
    assert {v.name: v.start for v in model.variables if v.name in ("u", "d")} == {"u": expected, "d": expected}
