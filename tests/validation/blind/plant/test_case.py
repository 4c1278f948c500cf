"""A case: the same every time, readable as a data set, its truth apart, its noise and nuisances as told."""

import json
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from pysim.io import read_dataset
from pysim.types import BadInput, Record
from validation.blind.plant import case as module
from validation.blind.plant.case import ANGLE_STEP, Case, Measured, measure, write_case
from validation.blind.plant.programme import programme
from validation.blind.plant.quantities import BOUNDS, Parameters, Strengths

NAMED = Case("a", "named", (("valve.deadband", "large"),), noise=0.1, seed=5)
PLAIN = replace(NAMED, kind="none", effects=())
SINE, WAVE = "frequency_response/O+50_A20/8Hz.txt", "stochastic/Tp1.0_fit.txt"


@pytest.fixture(autouse=True)
def short(monkeypatch: pytest.MonkeyPatch) -> None:
    """A session of two tests."""
    tests = tuple(test for test in programme() if test.file in (SINE, WAVE))
    monkeypatch.setattr(module, "programme", lambda: tests)


@cache
def once(case: Case) -> Measured:
    return measure(case)


def log(case: Case, file: str) -> Record:
    (data,) = (record.data for record in once(case).dataset.records if record.source == file)
    assert isinstance(data, Record)
    return data


def test_what_is_written_is_read_back_and_the_truth_lies_apart(tmp_path: Path) -> None:
    path = write_case(NAMED, tmp_path / "data", tmp_path / "truth")
    measured, back = once(NAMED), read_dataset(path)
    for old, new in zip(measured.dataset.records, back.records, strict=True):
        assert isinstance(old.data, Record)
        assert isinstance(new.data, Record)
        assert (new.source, new.kind, new.use, new.frequency) == (old.source, old.kind, old.use, old.frequency)
        assert np.abs(new.data["alphaPercent"] - old.data["alphaPercent"]).max() < 1e-3
    assert not list((tmp_path / "data").rglob("*truth*"))
    truth = json.loads((tmp_path / "truth" / "a.truth.json").read_text(encoding="utf-8"))
    assert truth["effect"] == ["valve.deadband"]
    assert truth["in_force"]["valve.deadband"]["u_0"] == NAMED.strengths().deadband__u_0
    clean = np.load(tmp_path / "truth" / "a.truth.npz")
    assert np.abs(clean[WAVE] - measured.clean[WAVE]).max() < 1e-5
    with pytest.raises(BadInput, match="holds files already"):
        write_case(NAMED, tmp_path / "data", tmp_path / "truth")


def test_the_same_case_twice_is_the_same_and_another_seed_is_not() -> None:
    for again, before in zip(measure(NAMED).dataset.records, once(NAMED).dataset.records, strict=True):
        assert isinstance(again.data, Record)
        assert isinstance(before.data, Record)
        assert np.array_equal(again.data.values, before.data.values)
    assert not np.array_equal(log(NAMED, WAVE)["alphaCMD"], log(replace(NAMED, seed=6), WAVE)["alphaCMD"])


def test_parameters_are_within_ten_percent_and_bounds() -> None:
    for seed in range(20):
        drawn, base = replace(NAMED, seed=seed).parameters(), Parameters()
        for name, (low, high) in BOUNDS.items():
            assert abs(getattr(drawn, name) / getattr(base, name) - 1) <= 0.1 + 1e-12
            assert low <= getattr(drawn, name) <= high
        assert drawn.beta == base.beta


def test_an_effect_is_in_force_and_its_absence_is_the_base() -> None:
    assert PLAIN.strengths() == Strengths()
    assert PLAIN.parameters() == NAMED.parameters()
    assert np.abs(once(NAMED).clean[WAVE] - once(PLAIN).clean[WAVE]).max() > 0.5


def test_readings_are_counts_with_the_noise_told() -> None:
    case = replace(PLAIN, noise=0.5)
    record, clean = log(case, WAVE), once(case).clean[WAVE]
    assert record["alphaPercent"] / ANGLE_STEP == pytest.approx(np.round(record["alphaPercent"] / ANGLE_STEP), abs=1e-9)
    assert (record["alphaPercent"] - clean[:, 0]).std() == pytest.approx(0.5, rel=0.04)
    assert (record["u"] - clean[:, 1]).std() == pytest.approx(0.01, rel=0.04)
    assert once(case).dataset.signal("u").noise == pytest.approx(0.01)


def test_without_the_spool_there_is_no_column_of_it() -> None:
    dataset = once(replace(PLAIN, spool=False)).dataset
    assert [signal.name for signal in dataset.signals] == ["alphaCMD", "alphaPercent"]
    assert log(replace(PLAIN, spool=False), WAVE).names == ("alphaCMD", "alphaPercent")


def test_nuisances_do_what_they_say() -> None:
    clean = once(PLAIN).clean
    offset = replace(PLAIN, nuisances=("offset",))
    assert once(offset).clean[WAVE][:, 0] - clean[WAVE][:, 0] == pytest.approx(offset.nuisance().offset)
    gain = replace(PLAIN, nuisances=("gain",))
    assert once(gain).clean[WAVE][:, 0] == pytest.approx(clean[WAVE][:, 0] * gain.nuisance().gain)
    shift = replace(PLAIN, nuisances=("shift",))
    late, seconds = once(shift).clean[SINE][:, 0], shift.nuisance().shift
    assert late[:-1] == pytest.approx(np.interp(np.arange(late.size - 1) * 0.004 + seconds,
                                                np.arange(late.size) * 0.004, clean[SINE][:, 0]), abs=0.5)  # fmt: skip
    assert np.abs(late - clean[SINE][:, 0]).max() > 0.1
    start = once(replace(PLAIN, nuisances=("start",))).clean[SINE][:, 0] - clean[SINE][:, 0]
    assert np.abs(start[:10]).max() > 20 * np.abs(start[-10:]).max()


@pytest.mark.parametrize(
    ("case", "expected"),
    [
        (PLAIN, ("none",)),
        (NAMED, ("valve.deadband",)),
        (replace(NAMED, kind="left-out", left_out=("valve.deadband",)), ("unknown",)),
        (replace(NAMED, kind="beyond", effects=(("shaft.force", "small"),)), ("unknown",)),
        (replace(NAMED, kind="pair", effects=(*NAMED.effects, ("oil.air", "large"))), ("valve.deadband", "oil.air")),
    ],
)
def test_the_right_answer(case: Case, expected: tuple[str, ...]) -> None:
    assert case.expected == expected
