"""What would be written out without end is refused where it is written, ahead of the compiler where the text tells."""

import pytest

from fmu_build.errors import BuildError
from fmu_build.front import load
from fmu_build.front.rumoca import session
from fmu_build.front.rumoca.refused import enormous
from tests.fmu_build.lower.compiling import loaded

BODY = "  Real x(start = 1, fixed = true);\nequation\n  der(x) = -x;\nend M;\n"
PART = "model Part parameter Integer n = 100000000; parameter Real a[:] = fill(1.0, n); end Part;\n"


@pytest.fixture
def _compiler_must_not_be_asked(monkeypatch):
    def asked(*_):
        raise AssertionError("asked")

    monkeypatch.setattr(session, "_ask_rumoca", asked)


@pytest.mark.usefixtures("_compiler_must_not_be_asked")
@pytest.mark.parametrize(
    ("text", "line"),
    [
        (f"model M\n  parameter Real a[:] = fill(1.0, 100000000);\n{BODY}", 2),
        (f"model M\n  parameter Real a[:, :] = zeros(1000, 100001);\n{BODY}", 2),
        (f"model M\n  parameter Real a[:] = linspace(0, 1, 1e8);\n{BODY}", 2),
        (f"model M\n  parameter Real a[:] = {{2*i for i in 1:100000000}};\n{BODY}", 2),
        (f"model M\n  constant Integer k = 100000;\n  parameter Integer n = 10*k;\n  Real y[n];\n{BODY}", 4),
        ("model M\n  Real x(start = 1);\nequation\n  for i in 1:100000000 loop der(x) = -x; end for;\nend M;\n", 4),
        (f"{PART}model M\n  Part part;\n{BODY}", 1),
    ],
)  # fmt: skip
def test_a_size_that_the_text_tells_is_refused_ahead_of_the_compiler(text, line):
    with pytest.raises(
        BuildError, match=r"elements are too many, of which 100,000 are supported; choose a sma"
    ) as caught:
        loaded(text)
    assert caught.value.line == line


def test_a_size_that_the_compiler_finds_is_refused_behind_it(tmp_path):
    file = tmp_path / "M.mo"
    file.write_text(
        f"model M\n  parameter Integer n = 2;\n  Real y[n](each start = 1, each fixed = true);\n"
        f"{BODY.replace('der(x) = -x', 'der(x) = -x; der(y) = -y')}",
        encoding="utf-8",
    )
    assert load("M", [file]).name == "M"
    with pytest.raises(BuildError, match=r"^.*:3: 300,00\d variables, 300,000 of them in y are too many"):
        load("M", [file], {"n": 300_000})


def chain(count: int, *, backwards: bool = False) -> str:
    lines = ["  parameter Real p1 = 1;\n"] + [f"  parameter Real p{k} = p{k - 1} + 1;\n" for k in range(2, count + 1)]
    return "model M\n" + "".join(reversed(lines) if backwards else lines) + BODY


@pytest.mark.usefixtures("_compiler_must_not_be_asked")
@pytest.mark.parametrize("backwards", [False, True])
def test_a_chain_of_many_thousand_parameters_is_refused_at_the_first_too_many(backwards):
    with pytest.raises(
        BuildError, match=r"p1001 is the last of 1,001 parameters that each follow.*value of its own"
    ) as caught:
        loaded(chain(5_000, backwards=backwards))
    assert caught.value.line == (5_001 - 1_001 + 1 if backwards else 1_002)


def test_a_chain_may_have_the_length_that_is_supported_and_no_more(monkeypatch):
    monkeypatch.setattr(enormous, "_LONGEST_CHAIN", 5)
    assert loaded(chain(5)).name == "M"
    with pytest.raises(BuildError, match="p6 is the last of 6"):
        loaded(chain(6))
