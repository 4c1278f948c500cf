"""Sets come back from their counts as they were; another author's copy of a wave says the same."""

import numpy as np
import pytest

from pysim.effects import STANDARD_LIBRARY, read_catalogue
from pysim.types import Dataset, Record
from validation.blind.proof import read_wave
from validation.diagnosis.sets import NAMES, packed, read_set, read_told, unpacked

WAVE = "stochastic/Tp0.5_heldout.txt"


def log(dataset: Dataset, file: str) -> Record:
    (data,) = (record.data for record in dataset.records if record.source == file)
    assert isinstance(data, Record)
    return data


def test_packing_loses_nothing() -> None:
    first = read_set("bench-01")
    content = packed(first)
    assert {key: a.dtype.name for key, a in content.items() if a.ndim} == {"alphaPercent": "int16", "u": "int16"}
    again = unpacked(first, "again", content)
    assert again.name == "again"
    assert again.signals == first.signals
    for one, other in zip(first.records, again.records, strict=True):
        assert isinstance(one.data, Record)
        assert isinstance(other.data, Record)
        assert np.array_equal(one.data.values, other.data.values)
        assert one.data.names == other.data.names


@pytest.mark.parametrize("name", ["bench-03", "bench-08", "bench-15"])
def test_the_held_out_wave_is_the_one_kept_elsewhere(name: str) -> None:
    mine = log(read_set(name), WAVE)
    theirs = read_wave(name).readings
    both = np.column_stack([mine["alphaPercent"], mine["u"]])[::2]
    assert both.shape == theirs.shape
    assert np.abs(both - theirs).max() < 1e-4


def test_all_are_there_and_differ() -> None:
    waves = [log(read_set(name), WAVE)["alphaPercent"] for name in NAMES]
    assert len({wave.tobytes() for wave in waves}) == 16
    noises = [read_set(name).signal("alphaPercent").noise for name in NAMES]
    assert noises.count(0.1) == 15
    assert noises[NAMES.index("bench-13")] == 0.25


def test_truths() -> None:
    told = {name: read_told(name) for name in NAMES}
    assert [name for name, truth in told.items() if truth is None] == list(NAMES[8:14])
    both = told["bench-15"]
    assert both is not None
    assert both.names == ("valve.offset", "spring.preload")
    effects = {effect.name: effect for effect in read_catalogue(STANDARD_LIBRARY)}
    assert both.strengths(effects["spring.preload"]) == {"F_0": 90.0}
    limited = told["bench-08"]
    assert limited is not None
    assert limited.strengths(effects["valve.rate_limit"]) == {"inverse_r_max": pytest.approx(1 / 30)}
    assert np.isnan(limited.strengths(effects["oil.air"])["eps"])
    assert limited.base["K_D"] == pytest.approx(0.23912072745732135)
