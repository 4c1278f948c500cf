"""What a closed FMU lacks, seen at its inputs and outputs."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from pysim.diagnosis import learn
from pysim.types import BadInput, Dataset, LearnedLaw, Record
from pysim.workflow import model_of, session_of, session_parts
from tests.toy import CATALOGUE, measured

FREE = {"m": (0.5, 5.0), "d": (0.0, 10.0), "k": (1.0, 100.0)}


def located(closed: Path, data: Dataset) -> tuple[LearnedLaw, ...]:
    model = model_of(closed)
    parts = session_parts(model, data, bounds=FREE, values={}, reference_hz=None)
    found = learn(session_of(parts))
    assert found.learned == ()  # nothing can be added
    return found.missing


def test_friction_inside_is_a_force_at_the_input_over_the_speed(foreign: Path) -> None:
    """0.4 N against the speed, which the FMU does not even show: the rate of its output does."""
    law = located(foreign, measured(1, "toy.friction", F_c=0.4))[0]
    assert (law.slot, law.argument, law.argument_unit, law.unit) == ("F", "der(x)", "m/s", "N")
    assert law.share > 0.95
    at = [float(np.interp(v, law.knots, law.coefficients)) for v in (-0.5, 0.5)]
    assert at[0] - at[1] == pytest.approx(0.8, rel=0.25)  # what damping takes as well, a slope, is no part of the curve


def test_a_sensor_that_is_not_linear_is_a_law_at_the_output_over_itself(foreign: Path) -> None:
    """x + 0.05 x^2 is shown for x."""
    data = measured(2, "toy.friction", F_c=0.0)
    records = []
    for one in data.records:
        assert isinstance(one.data, Record)
        values = one.data.values.copy()
        values[:, 1] += 0.05 * values[:, 1] ** 2
        records.append(replace(one, data=replace(one.data, values=values)))
    law = located(foreign, replace(data, records=tuple(records)))[0]
    assert (law.slot, law.argument, law.unit) == ("x", "x", "m")
    assert law.share > 0.9
    bend = np.polyfit(law.knots, law.coefficients, 2)[0]
    assert bend == pytest.approx(0.05, rel=0.2)


def test_no_effect_stands_in_a_closed_fmu(foreign: Path) -> None:
    parts = session_parts(model_of(foreign), measured(1), bounds=FREE, values={}, reference_hz=None)
    with pytest.raises(BadInput, match="class is not at hand"):
        learn(session_of(parts), [CATALOGUE["toy.friction"]])
