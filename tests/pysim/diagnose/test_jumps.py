"""A log that ends in one hollow or the other is told from those that no small change moves far."""

from dataclasses import replace

import numpy as np

from pysim.diagnose.fitted import Fitted
from pysim.diagnose.jumps import jumping, logs, without
from pysim.diagnose.refit import refit_from
from pysim.diagnose.residuals import Ruler
from tests.pysim.diagnose.logs import sines, wave
from tests.pysim.diagnose.marble import LAST, TRUTH, pushed
from tests.pysim.diagnose.test_steps import mass


def fitted(over: float) -> tuple[Ruler, Fitted]:
    ruler, what = pushed(over, seed=3)
    first = ruler.evaluation(what, what.space.to_search(np.array([TRUTH[name] for name in what.space.keys])))
    return ruler, Fitted(what, refit_from(ruler, what, first)[0])


def test_a_log_that_ends_on_the_ridge_jumps() -> None:
    assert jumping(*fitted(1e-5)) == [LAST]


def test_one_that_is_well_over_it_does_not_and_neither_does_one_far_below() -> None:
    assert jumping(*fitted(0.1)) == []
    assert jumping(*fitted(-0.1)) == []


def test_nothing_is_said_of_a_model_that_is_far_off_or_where_most_would_be_left_out() -> None:
    ruler, at = fitted(1e-5)
    off = replace(at, point=replace(at.point, cost=10 * at.point.cost))
    assert jumping(ruler, off) == []
    most = ruler.with_other(targets=ruler.targets[-1:], skips=())
    assert jumping(most, replace(at, point=most.evaluation(at.what, at.point.x))) == []


def test_a_smooth_model_has_none() -> None:
    assert jumping(*mass(1e-6)) == []


def test_every_log_has_its_rows() -> None:
    still = [sines(np.zeros, 0.1, (1.0, 100.0)), wave(np.zeros(50), 0.1)]
    ruler = Ruler(tuple(still))
    found = logs(ruler)
    assert [source for source, _ in found] == ["1Hz", "100Hz", "y"]
    sizes = [rows.stop - rows.start for _, rows in found]
    assert sizes == [2 * still[0].logs[0].count + 1, 2 * still[0].logs[1].count + 1, 50]
    assert sum(sizes) == sum(made.size for made in ruler.whitenings)


def test_logs_of_one_name_are_rows_of_their_own() -> None:
    twice = sines(np.zeros, 0.1, (1.0, 2.0))
    twice = replace(twice, logs=tuple(replace(log, source="a.txt") for log in twice.logs))
    ruler = Ruler((twice, wave(np.zeros(50), 0.1), wave(np.zeros(50), 0.1)))
    assert [source for source, _ in logs(ruler)] == ["a.txt", "a.txt", "y", "y"]
    assert logs(ruler)[-1][1].stop == sum(made.size for made in ruler.whitenings)


def test_logs_are_left_out_of_targets_one_by_one() -> None:
    several = (sines(np.zeros, 0.1, (0.5, 1.0, 2.0)), wave(np.zeros(50), 0.1))
    assert without(several, ()) == several
    (fewer,) = without(several, ("1Hz", "y"))
    assert [log.source for log in fewer.logs] == [run.record for run in fewer.runs] == ["0.5Hz", "2Hz"]
    assert without(several, ("0.5Hz", "1Hz", "2Hz")) == several[1:]
