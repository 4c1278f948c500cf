"""Units of time derivatives."""

import pytest

from fmu_build.emit.units import parse_unit
from fmu_build.lower.table import derivative_unit


@pytest.mark.parametrize(
    ("unit", "expected"),
    [
        ("m", "m/s"),
        ("m/s", "m/s2"),
        ("1", "1/s"),
        ("kg/(m.s)", "kg/(m.s2)"),
        ("Pa/(m3/s)", "(Pa/(m3/s))/s"),
        ("(m/s)", "((m/s))/s"),
    ],
)
def test_a_derivative_is_by_the_second(unit: str, expected: str) -> None:
    assert derivative_unit(unit) == expected
    whole, rate, second = parse_unit(unit), parse_unit(expected), parse_unit("s")
    assert whole is not None
    assert rate is not None
    assert second is not None
    assert rate.times(second) == whole
