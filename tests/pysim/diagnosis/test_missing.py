"""What is missing in the model is named as without where outputs lack samples, and only if its true form is better."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from pysim.diagnosis import diagnose
from pysim.diagnosis.candidate import Models
from pysim.diagnosis.floors import logs, white_floors
from pysim.diagnosis.left import follows, tone
from pysim.types import Dataset, Record
from pysim.types.answer import Verdict
from tests.pysim.diagnosis.plants import given, measured, refitted, with_library

LACKING = 0.2  # of the samples


def lacking(data: Dataset) -> Dataset:
    """The same logs with empty cells of the position."""
    rng, records = np.random.default_rng(0), []
    for record in data.records:
        assert isinstance(record.data, Record)
        values = record.data.values.copy()
        values[rng.random(len(values)) < LACKING, record.data.names.index("x")] = np.nan
        records.append(replace(record, data=replace(record.data, values=values)))
    return replace(data, records=tuple(records))


def test_what_is_named_is_what_is_named_without() -> None:
    data = measured("mass", {"mass.drag": {"c_2": 1.0}}, fit=(1, 2))
    whole, less = (diagnose(replace(given("mass", one), build_law=None)) for one in (data, lacking(data)))
    assert [one.effect.name for one in less.effects] == [one.effect.name for one in whole.effects] == ["mass.drag"]
    assert less.verdict is whole.verdict
    (one,), (other,) = less.effects, whole.effects
    for own, expected in zip(one.estimates, other.estimates, strict=True):
        assert abs(own.value - expected.value) < 3 * own.std
        assert 0.5 < own.std / expected.std * np.sqrt(1 - LACKING) < 2  # both are from a few blocks
    assert less.history[-1].fit == pytest.approx(1.0, abs=0.1)
    assert less.failures[0].error == pytest.approx(whole.failures[0].error, rel=0.25)


ODD = """
package Odd
  model Rub "Friction that its true form does not have"
    extends Mass.PartialForce;
    parameter Real F(unit="N", min=0, max=5, nominal=0.5) = 0 "0 = off";
  equation
    f = 0.01*F*x;
    annotation(__HydraulicTestBench(effect="odd.rub", slot="force"));
  end Rub;
  model Smooth "Friction"
    extends Mass.PartialForce;
    parameter Real F(unit="N", min=0, max=5, nominal=0.5) = 0 "0 = off";
  equation
    f = -F*tanh(v/0.02);
    annotation(__HydraulicTestBench(smooth="odd.rub", slot="force"));
  end Smooth;
end Odd;
"""


def test_an_effect_is_named_only_if_its_true_form_passes_the_test_too(tmp_path: Path) -> None:
    found = diagnose(with_library(tmp_path / "Odd.mo", ODD, measured("mass", {"mass.friction": {"F_c": 0.5}})))
    assert found.rivals[0].test is not None
    assert found.rivals[0].test.verdict is Verdict.BETTER  # in its smooth form
    assert (found.effects, found.complete, found.verdict) == ((), False, "unknown")
    assert [step.step for step in found.history] == ["prior", "refit"]


def test_noise_that_lacks_samples_follows_nothing_and_has_no_tone() -> None:
    data = lacking(measured("mass", fit=(1, 2), length=16.0))
    fit = refitted(Models(given("mass", data, ())))
    rests = {source: rest for source, own in logs(fit) for rest in own.values()}
    for record in data.records[:2]:
        assert isinstance(record.data, Record)
        np.testing.assert_array_equal(np.isnan(rests[record.source]), np.isnan(record.data["x"]))
    answer = follows(fit, data, 6)
    assert answer is not None
    assert answer.t < 3
    assert tone(fit, data, 0.01) is None
    (floor,) = white_floors(fit).values()
    assert floor.sd == pytest.approx(1e-3, rel=0.1)


def test_a_tone_is_found_where_samples_lack() -> None:
    data = measured("mass", fit=(1, 2), length=16.0)
    records = []
    for record in data.records:
        assert isinstance(record.data, Record)
        values = record.data.values.copy()
        values[:, record.data.names.index("x")] += 2e-3 * np.sin(2 * np.pi * 7.3 * record.data.time)
        records.append(replace(record, data=replace(record.data, values=values)))
    loud = lacking(replace(data, records=tuple(records)))
    assert tone(refitted(Models(given("mass", loud, ()))), loud, 0.01) == pytest.approx(7.3, abs=0.1)
