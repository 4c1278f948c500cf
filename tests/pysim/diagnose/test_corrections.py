"""Gains, offsets, shifts and wrong starts that were put into a toy's measurements come out with their sizes."""

import numpy as np
import pytest

from pysim.diagnose.corrections import allowing, held_beside, in_words, nuisances, settled, told_apart
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.nuisance import GAIN, OFFSET, SHIFT
from pysim.diagnose.refit import refit
from pysim.diagnose.residuals import rulers
from pysim.diagnose.subject import extended
from pysim.simulate import Rodas, simulate
from pysim.types import Dataset, Experiment, MeasuredRecord, MeasuredSignal, Record, Signal
from tests.pysim.diagnose.toy import NOISE, base, toy_subject

TRUE = {"m": 1.05, "d": 0.75, "k": 21.0}


def logged(seed: int, *, gain: float = 1.0, offset: float = 0.0, late: float = 0.0, start: float = 0.0) -> Dataset:
    """Waves of the toy, read by a bad sensor and logged `late` s after the force; "start" is where the mass begins."""
    rng, model, records = np.random.default_rng(seed), base(), []
    for name, use in (("a.txt", "fit"), ("b.txt", "fit"), ("c.txt", "validate")):
        knots = np.arange(0.0, 12.01, 0.4)
        push = 6 * rng.standard_normal(knots.size)
        push[:3] = 0.0
        command, times = Signal.through(knots, push), np.arange(0.0, 11.9, 0.02)
        run = Experiment(times + late, ("x",), {"F": command}).override(**TRUE, x=start if name == "a.txt" else 0.0)
        clean = simulate(model, run, solver=Rodas(rtol=1e-8, atol=1e-8))["x"]
        rows = np.column_stack([command.value(times), gain * clean + offset + NOISE * rng.standard_normal(times.size)])
        records.append(MeasuredRecord(name, "stochastic", use, Record(times, rows, ("F", "x"), ("N", "m"))))
    signals = (
        MeasuredSignal("F", "input", "N", "force", "F"),
        MeasuredSignal("x", "output", "m", "position", "x", noise=NOISE),
    )
    return Dataset("toy", "a mass", "mass", signals, tuple(records))


def fitted(data: Dataset):  # type: ignore[no-untyped-def]
    subject = toy_subject(data)
    what = extended(subject, ())
    start = what.space.to_search(what.space.start)
    ruler, held = allowing(*rulers(subject.targets), what, start)
    ruler, first = told_apart(ruler, what, ruler.evaluation(what, start))
    return ruler, held, Fitted(what, refit(ruler, what, first))


def test_sizes_of_bad_sensors_and_clocks() -> None:
    ruler, held, at = fitted(logged(1, offset=0.02, late=0.006))
    found = settled(ruler, held, at)
    seen = {n.suspect.kind: n for n in found.seen}
    assert GAIN not in seen  # mass, damper and spring together take over any gain
    assert seen[OFFSET].found
    assert seen[OFFSET].low < 0.02 < seen[OFFSET].high
    assert seen[SHIFT].found
    assert seen[SHIFT].low < 0.006 < seen[SHIFT].high
    freedom = found.ruler.freedom - at.what.space.size
    assert abs(found.at.point.cost - freedom) < 4 * np.sqrt(2 * freedom)
    assert found.held is not None
    left = found.held.at(found.at.what, found.at.point.x)
    assert left is not None
    assert abs(left @ left - left.size) < 5 * np.sqrt(2 * left.size)
    told = " ".join(in_words(found.seen, {"x": "m"}))
    assert "x is off by +0.0199" in told or "x is off by +0.02" in told
    assert "ms after the command" in told


def test_what_is_there_no_more_is_put_back() -> None:
    ruler, held, at = fitted(logged(2, offset=0.02))
    before = ruler.targets[0].measured.values  # type: ignore[attr-defined]
    once = settled(ruler, held, at)
    assert once.ruler.targets[0].measured.values.mean() == pytest.approx(before.mean() - 0.02, abs=1e-3)  # type: ignore[attr-defined]
    clean = once.ruler.with_other(targets=ruler.targets, taken={}, suspected=())
    assert nuisances(clean, at.what, clean.evaluation(at.what, at.point.x)) == ()
    ruler, held, at = fitted(logged(2))
    assert not any(n.found for n in settled(ruler, held, at).seen)


def test_each_model_is_judged_with_its_own_sensors() -> None:
    ruler, held, at = fitted(logged(4, offset=0.02, late=0.006))
    assert held is not None
    wrong, right = held.at(at.what, at.point.x), held_beside(ruler, held, at).at(at.what, at.point.x)
    assert wrong is not None
    assert right is not None
    assert wrong @ wrong > 100 * wrong.size
    assert abs(right @ right - right.size) < 5 * np.sqrt(2 * right.size)


def test_intervals_hold() -> None:
    inside = 0
    for seed in range(12):
        ruler, _, at = fitted(logged(100 + seed, offset=0.003))
        inside += sum(n.low < 0.003 < n.high for n in nuisances(ruler, at.what, at.point) if n.suspect.kind == OFFSET)
    assert inside >= 9  # of 12 at 95 percent: fewer once in 400 times


def test_a_wrong_start_is_left_out_and_a_right_one_is_not() -> None:
    ruler, held, at = fitted(logged(3, start=0.05))
    assert ruler.skips[0] > 0
    assert ruler.skips[1] == 0
    assert held is not None
    assert not any(held.skips)
    samples = round(ruler.skips[0] / 0.02)
    assert ruler.freedom == 2 * 595 - samples - ruler.span.rank
    assert at.point.residual.size == 2 * 595 - samples
