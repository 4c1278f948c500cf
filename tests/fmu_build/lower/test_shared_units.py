"""Units handed on along sums and aliases."""

import pytest

from fmu_build.front import load
from fmu_build.lower.shared_units import unit_of

TEXT = """
model M
  input Real w(unit="rad");
  Real known(unit="m", start=0);
  Real alias;
  Real far;
  input Real left;
  Real difference;
  Real product;
  Real torn;
  Real rate;
equation
  der(known) = 1;
  alias = known;
  far = -alias;
  difference = left - w;
  product = 2*known;
  torn = known + w;
  rate = der(known);
end M;
"""


@pytest.fixture(scope="module")
def flat(tmp_path_factory):
    file = tmp_path_factory.mktemp("units") / "M.mo"
    file.write_text(TEXT, encoding="utf-8")
    return load("M", [file])


@pytest.mark.parametrize(
    ("name", "unit"),
    [
        ("known", "m"),
        ("alias", "m"),
        ("far", "m"),
        ("left", "rad"),
        ("difference", "rad"),
        ("product", None),
        ("torn", None),
        ("rate", None),
    ],
)
def test_a_sum_has_one_unit(flat, name, unit):
    assert unit_of(name, flat) == unit
