"""How long a model takes to come to rest, against a closed form."""

import math

import numpy as np
import pytest

from pysim.identify.greybox import Treatment
from pysim.identify.greybox.context import Context
from pysim.types import Model
from tests.pysim.identify.greybox import measurements as m


@pytest.mark.parametrize("slower", [1.0, 1e5])
def test_a_lag_comes_to_rest_in_some_time_constants_however_slow_it_is(lag: Model, slower: float) -> None:
    """A hundredth is left after T ln 100; looks are 5 percent apart. A slow plant once took a step a millisecond."""
    constant, time = 0.1 * slower, slower * np.arange(0, 3, 0.02)
    data = m.dataset([m.log(time, np.ones(time.size), np.ones(time.size))])
    context = Context(lag, data, {"T": constant}, ("y",), {"y": 1.0}, Treatment(), (None,))
    assert context.settling == pytest.approx(constant * math.log(100), rel=0.06)
