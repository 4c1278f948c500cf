"""Gains, offsets, shifts and wrong starts that were put into a toy's measurements come out with their sizes."""

import numpy as np
import pytest

from pysim.diagnose.corrections import (
    allowing,
    corrected,
    held_beside,
    implausible,
    leaning,
    nuisances,
    recounted,
    settled,
    settled_before,
    told_apart,
)
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.nuisance import GAIN, OFFSET, SHIFT, Suspect, undisturbed
from pysim.diagnose.refit import refit
from pysim.diagnose.residuals import rulers
from pysim.diagnose.subject import extended
from pysim.simulate import Rodas, simulate
from pysim.types import Dataset, Experiment, Signal
from tests.pysim.diagnose.toy import BENCH, base, toy_subject

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
        records.append(BENCH.log(times, command, gain * clean + offset, rng, source=name, use=use))
    return BENCH.dataset(*records)


def fitted(data: Dataset):  # type: ignore[no-untyped-def]
    subject = toy_subject(data)
    what = extended(subject, ())
    start = what.space.to_search(what.space.start)
    ruler, held = allowing(*rulers(subject.targets), what, start)
    ruler, first = told_apart(ruler, ruler.evaluation(what, start))
    return ruler, held, Fitted(what, refit(ruler, what, first))


def test_sizes_of_bad_sensors_and_clocks() -> None:
    ruler, _, at = fitted(logged(1, offset=0.012, late=0.006))
    found = settled(ruler, at)
    seen = {n.suspect.kind: n for n in found.seen}
    assert set(seen) == {OFFSET, SHIFT}  # mass, damper and spring together take over any gain
    for kind, true in ((OFFSET, 0.012), (SHIFT, 0.006)):
        assert abs(seen[kind].value - true) < seen[kind].high - seen[kind].low  # four standard deviations
    freedom = found.lean.freedom - at.what.space.size
    assert abs(found.at.point.cost - freedom) < 4 * np.sqrt(2 * freedom)
    again = settled_before(ruler, at, found.at.point.x, found.lean.suspected)
    assert again.at.point.residual == pytest.approx(found.at.point.residual, abs=1e-12)


def test_a_shift_too_long_for_a_straight_line() -> None:
    ruler, _, at = fitted(logged(6, late=0.014))
    found = settled(ruler, at)
    (shift,) = found.seen
    assert shift.suspect.kind == SHIFT
    assert abs(shift.value - 0.014) < shift.high - shift.low
    assert found.ruler.taken == {shift.suspect: pytest.approx(shift.value, abs=1e-4)}
    freedom = found.lean.freedom - at.what.space.size
    assert abs(found.at.point.cost - freedom) < 4 * np.sqrt(2 * freedom)
    assert found.at.point.cost < at.point.cost - 25
    assert found.ruler.only(()).targets[0].measured.time == pytest.approx(ruler.targets[0].measured.time, abs=1e-12)  # type: ignore[attr-defined]


def test_only_who_is_to_blame_is_taken_off() -> None:
    ruler, _, at = fitted(logged(2, offset=0.012))
    found = settled(ruler, at)
    assert {n.suspect.kind for n in found.seen} == {OFFSET}
    before, (after, *_) = ruler.targets[0].measured.values, undisturbed(ruler.targets, found.amounts)  # type: ignore[attr-defined]
    assert after.measured.values.mean() == pytest.approx(before.mean() - 0.012, abs=1e-3)  # type: ignore[attr-defined]
    ruler, _, at = fitted(logged(2))
    assert settled(ruler, at).seen == ()
    assert undisturbed(ruler.targets, {}) == ruler.targets


def test_a_size_that_no_sensor_has_is_implausible() -> None:
    ruler, _, at = fitted(logged(5, offset=2.0))
    assert [suspect.kind for suspect in implausible(ruler, at.point)] == [OFFSET]
    ruler, _, at = fitted(logged(5, offset=0.012))
    assert implausible(ruler, at.point) == ()


def test_each_model_is_judged_with_its_own_sensors() -> None:
    ruler, held, at = fitted(logged(4, offset=0.012, late=0.006))
    assert held is not None
    wrong, right = held.at(at.what, at.point.x), held_beside(ruler, held, at).at(at.what, at.point.x)
    assert wrong is not None
    assert right is not None
    assert wrong @ wrong > 100 * wrong.size
    assert abs(right @ right - right.size) < 5 * np.sqrt(2 * right.size)


def test_a_gain_that_is_taken_off_is_taken_off_the_noise() -> None:
    ruler, _, at = fitted(logged(4, gain=1.25))
    assert ruler.noise  # estimated: larger by the gain, if it were not for the sensor's own
    size = ruler.freedom
    right = corrected(ruler.plain, {Suspect(GAIN, "toy", "x"): 0.25})
    wider = corrected(ruler.plain, {Suspect(GAIN, "toy", "x"): 0.0})
    scaled = at.what.space.values(at.point.x)
    assert right.targets[0].measured.values == pytest.approx(wider.targets[0].measured.values / 1.25)  # type: ignore[attr-defined]
    # the model of the signal over its gain leaves as much over the noise as that of the signal: m, d and k scale x
    x = at.what.space.to_search(np.array([1.25 * scaled[name] for name in at.what.space.keys]))
    before, after = wider.at(at.what, at.point.x), right.at(at.what, x)
    assert before is not None
    assert after is not None
    assert abs(before @ before - size) < 5 * np.sqrt(2 * size)
    assert after == pytest.approx(before, abs=0.05)


def test_parameters_lean_as_far_as_a_refit_without_nuisances_takes_them() -> None:
    ruler, _, at = fitted(logged(6))
    assert len(ruler.suspected) > 1
    for lean in (ruler.plain, ruler.only(ruler.suspected[:1])):
        counted = recounted(ruler, lean, at)
        end = refit(lean, at.what, counted.point, rounds=5)
        deviations = np.sqrt(np.diag(np.linalg.inv(end.jacobian.T @ end.jacobian)))
        assert np.max(np.abs(end.x - at.point.x) / deviations) > 0.2
        assert np.max(np.abs(leaning(lean, counted) - end.x) / deviations) < 0.03


def test_intervals_hold() -> None:
    inside = 0
    for seed in range(6):
        ruler, _, at = fitted(logged(100 + seed, offset=0.003))
        inside += sum(n.low < 0.003 < n.high for n in nuisances(ruler, at.point) if n.suspect.kind == OFFSET)
    assert inside >= 4  # of 6 at 95 percent: fewer once in 400 times


def test_a_wrong_start_is_left_out_and_a_right_one_is_not() -> None:
    ruler, held, at = fitted(logged(3, start=0.05))
    assert ruler.skips[0] > 0
    assert ruler.skips[1] == 0
    assert held is not None
    assert not any(held.skips)
    samples = round(ruler.skips[0] / 0.02)
    assert ruler.freedom == 2 * 595 - samples - ruler.span.rank
    assert at.point.residual.size == 2 * 595 - samples
