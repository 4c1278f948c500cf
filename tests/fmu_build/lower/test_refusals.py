"""What cannot be lowered is refused with the line it stands in."""

import pytest

from fmu_build.errors import BuildError
from tests.fmu_build.lower.compiling import body


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("Real x; Real y; Real z;\nequation\nx = 1;\nx = time;\ny = z;", 4, "singular"),
        ("Real x; Real y;\nequation\nx + y = 1;\nx + y = 2;", 4, "contradict or repeat"),
        ("Real x; Real y; Real z;\nequation\nx + z = y;\n2*x = time + z;\n3*x = y + time;", 4, "contradict or repeat"),
        (
            "parameter Real a = 2; Real x; Real y;\nequation\na*x + sin(a)*y = 1;\n2*a*x + 2*sin(a)*y = time;",
            4,
            "contradict or repeat",
        ),
        ("input Real u; Real x; Real v;\nequation\nder(x) = v;\nx = u;", 5, "derivative of the input u"),
        (
            "Real x(start = 0, fixed = true);\ninitial equation\nx = 1;\nequation\nder(x) = 1;",
            4,
            "too many initial conditions",
        ),
        (
            "parameter Real p(fixed = false);\nReal x(start = 0, fixed = true);\nequation\nder(x) = p;",
            1,
            "p has fixed = false",
        ),
        (
            "Real x(start = 0, fixed = true); Real y; discrete Real a(start = 0);\nequation\nder(x) = 1; y = 2*x;\n"
            "when x > 1 then\na = pre(y);\nend when;",
            6,
            "pre of y",
        ),
        ("parameter Real a = b;\nparameter Real b = a;\nReal x = a*time;\nequation", 1, "cyclic dependency"),
        ("parameter Real t[3] = {1, 2, 3};\nReal x = t[4]*time;\nequation", 3, "1 to 3|bounds|range"),
    ],
)
def test_refused(text, line, message):
    with pytest.raises(BuildError, match=message) as caught:
        body(text)
    assert caught.value.line == line
    assert caught.value.file is not None
