"""The count of intervals: its noise, its binomial interval, and that it goes on where it stopped."""

from pathlib import Path

import numpy as np
import pytest

from pysim.types import MeasuredRecord, Record
from validation.fit_coverage import mass
from validation.fit_coverage.mass import NOISE, VARIANTS, coloured, counted, finding
from validation.virtual_pump import measured


def test_coloured_noise_has_its_size_and_memory() -> None:
    noise = coloured(np.random.default_rng(0), 200_000, 0.8)
    assert np.std(noise) == pytest.approx(NOISE, rel=0.02)
    assert np.corrcoef(noise[1:], noise[:-1])[0, 1] == pytest.approx(0.8, abs=0.01)
    starts = [coloured(np.random.default_rng(seed), 2, 0.8)[0] for seed in range(4000)]
    assert np.std(starts) == pytest.approx(NOISE, rel=0.05)  # no run-in


def test_a_share_is_wrong_only_as_far_as_chance_cannot_be_it() -> None:
    half = [{"m": seed % 20 != 0, "c": seed % 20 != 1} for seed in range(400)]
    assert finding(VARIANTS[0], half).holds
    low = [{"m": seed % 5 != 0, "c": True} for seed in range(400)]  # 90 percent of 800
    assert not finding(VARIANTS[0], low).holds
    assert 1.0 < finding(VARIANTS[0], low).value < 5.0  # 95 less the upper end of the binomial interval
    assert not finding(VARIANTS[0], [{"m": True, "c": True}] * 400).holds  # too wide is wrong as well


def test_a_count_goes_on_where_it_stopped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    seeds: list[int] = []

    def one_fit(model: object, variant: object, seed: int) -> dict[str, bool]:
        seeds.append(seed)
        return {"m": seed != 1}

    monkeypatch.setattr(mass, "one_fit", one_fit)
    assert list(counted(VARIANTS[0], 2, tmp_path)) == [{"m": True}, {"m": False}]
    assert list(counted(VARIANTS[0], 3, tmp_path)) == [{"m": True}, {"m": False}, {"m": True}]
    assert seeds == [0, 1, 2]
    monkeypatch.setattr(mass, "code", lambda: "another")
    assert list(counted(VARIANTS[0], 1, tmp_path)) == [{"m": True}]
    assert seeds == [0, 1, 2, 0]


def test_noise_leaves_what_is_known_of_a_log() -> None:
    data = Record(np.arange(3.0), np.ones((3, 2)), ("alphaCMD", "u"), ("%", "1"))
    known = MeasuredRecord("wave.txt", "stochastic", "validate", data, initial="rest")
    noisy = measured([known], 1).records[0]
    assert noisy.initial == "rest"
    assert np.array_equal(noisy.data["alphaCMD"], data["alphaCMD"])
    assert not np.any(noisy.data["u"] == 1.0)
