"""One log of which a model takes another branch than the plant bends everything, until it is set aside."""

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.corrections import as_noise
from pysim.diagnose.refit import refit_from
from pysim.diagnose.set_aside import set_aside
from pysim.diagnose.subject import Extended
from tests.pysim.diagnose.marble import TRUTH, pushed

Array = NDArray[np.float64]


def at(what: Extended, g: float, tau: float) -> Array:
    return what.space.to_search(np.array([{"g": g, "tau": tau}[name] for name in what.space.keys]))


def test_the_log_that_bends_everything_falls_into_its_place() -> None:
    ruler, what = pushed(over=0.005, seed=1)
    bent = refit_from(ruler, what, ruler.evaluation(what, at(what, g=1.3, tau=0.3)))[0]
    assert bent.cost > 50 * ruler.freedom
    found = set_aside(ruler, what, bent)
    assert found is not None
    assert as_noise(ruler, found[0])
    for name, value in what.space.values(found[0].x).items():
        assert abs(value / TRUTH[name] - 1) < 0.002, name


def test_a_misfit_of_all_logs_is_no_single_logs() -> None:
    ruler, what = pushed(over=-0.9, seed=2)
    assert set_aside(ruler, what, ruler.evaluation(what, at(what, g=1.1, tau=0.5))) is None


def test_what_is_most_of_the_data_is_never_set_aside() -> None:
    ruler, what = pushed(over=0.005, seed=1)
    two = ruler.with_other(targets=ruler.targets[-2:], skips=())
    bent = two.evaluation(what, at(what, g=0.95, tau=0.5))
    assert bent.cost > 100 * two.freedom
    assert set_aside(two, what, bent) is not None  # 200 rows beside 300
    one = ruler.with_other(targets=ruler.targets[-1:], skips=())
    assert set_aside(one, what, one.evaluation(what, bent.x)) is None
