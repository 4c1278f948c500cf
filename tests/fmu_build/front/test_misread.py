"""Valid declarations that the compiler miscounts are named as the reason."""

from pathlib import Path

import pytest

from fmu_build.errors import BuildError
from fmu_build.front import load

TEXT = """package P
  type Temperature = Real(unit = "K");
  model Part parameter Real k = 1; Real y = k*time; end Part;
  model Pair Part b[2]; end Pair;
  model Wide parameter Real w[2] = {1, 2}; Real y = w[1]*time; end Wide;
  model One Wide b; end One;
  model Inside
    %s
  end Inside;
  model M %s Inside inside; end M;
end P;
"""


def load_with(folder: Path, inside: str, outside: str = "") -> None:
    file = folder / "P.mo"
    file.write_text(TEXT % (inside, outside), encoding="utf-8")
    load("P.M", [file])


@pytest.mark.parametrize(
    ("inside", "outside", "said"),
    [
        ("outer Real T; Real y = T;", "inner Real T = time;", "outer Real T is a plain variable"),
        ("outer Temperature T; Real y = T;", "inner Temperature T = time;", "outer Temperature T is a plain variable"),
        ("Pair v[2](each b(k = {8, 9}));", "", "each in front .* leave each out"),
    ],
)
def test_the_declaration_to_blame_is_named(inside: str, outside: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(BuildError, match=said) as caught:
        load_with(tmp_path, inside, outside)
    assert (caught.value.file, caught.value.line) == (tmp_path / "P.mo", 8)


@pytest.mark.parametrize(
    ("inside", "outside"),
    [
        ("outer Part T; Real y = T.y;", "inner Part T;"),
        ("outer parameter Real T; Real y = T;", "inner parameter Real T = 3;"),
        ("Pair v[2](b(k = {{8, 9}, {8, 9}}));", ""),
        ("One v[2](each b(w = {8, 9}));", ""),
    ],
)
def test_what_is_counted_right_is_taken(inside: str, outside: str, tmp_path: Path) -> None:
    load_with(tmp_path, inside, outside)


def test_an_each_that_is_followed_is_not_to_blame(tmp_path: Path) -> None:
    with pytest.raises(BuildError, match="types or sizes do not agree"):
        load_with(tmp_path, "One v[2](each b(w = {8, 9})); Integer i; equation i = time;")
