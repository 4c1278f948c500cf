"""A force of a frequency of its own is found with its size, and none where nothing swings by itself."""

import re
from dataclasses import replace

import numpy as np
import pytest

from pysim.diagnose.fitted import Fitted
from pysim.diagnose.locating.laws import slot_laws
from pysim.diagnose.locating.tone import tones
from pysim.diagnose.refit import refit
from pysim.diagnose.residuals import rulers
from pysim.diagnose.subject import extended
from pysim.effects import slots
from pysim.simulate import Rodas, simulate
from pysim.types import Dataset, Experiment, Missing, Record, Signal
from tests.pysim.diagnose.bench import HOLD
from tests.pysim.diagnose.locating.test_locate import probed
from tests.pysim.diagnose.toy import base, library, measured, toy_subject

FREQUENCY = 3.71  # Hz


def with_tone(size: float) -> Dataset:
    """The toy is linear: what a force does besides adds to what was measured. It begins at its top, with few jolts."""
    dataset, hold = measured(5), HOLD
    sine = np.array([[[size, np.pi / 2, 2 * np.pi * FREQUENCY, 0.0]]])
    force = Signal(np.array([-hold]), np.zeros((1, 4)), sine)
    records = []
    for record in dataset.records:
        assert isinstance(record.data, Record)
        run = Experiment(record.data.time, ("x",), {"F": force}, start=-hold).override(m=1.05, d=0.75, k=21.0)
        more = simulate(base(), run, solver=Rodas(rtol=1e-9, atol=1e-9))["x"]
        values = record.data.values + np.column_stack([np.zeros_like(more), more])
        records.append(replace(record, data=replace(record.data, values=values)))
    return replace(dataset, records=tuple(records))


def found(dataset: Dataset) -> tuple[Missing, ...]:
    given = toy_subject(dataset)
    ruler, _ = rulers(given.targets)
    what = extended(given, ())
    first = ruler.evaluation(what, what.space.to_search(what.space.start))
    current = Fitted(what, refit(ruler, what, first, rounds=5))
    return tones(ruler, current, slot_laws(slots("Toy.Mass", [library()]), base()), probed)


def test_a_force_of_its_own_frequency_has_its_size() -> None:
    (force,) = found(with_tone(0.6))
    assert (force.slot, force.depends_on, force.shape.unit) == ("force", "time", "N")
    assert force.share > 0.9
    truth = 0.6 * np.sin(2 * np.pi * FREQUENCY * (force.shape.argument + HOLD) + np.pi / 2)
    assert np.mean((truth >= force.shape.low) & (truth <= force.shape.high)) > 0.9
    assert np.max(force.shape.value) == pytest.approx(0.6, rel=0.05)
    told = float(re.search(r"sin\(2 pi ([\d.]+) Hz", force.formula)[1])
    assert told == pytest.approx(FREQUENCY, abs=0.1 / 12)  # a tenth of a line of 12 s


def test_noise_has_no_tone() -> None:
    assert found(measured(5)) == ()
