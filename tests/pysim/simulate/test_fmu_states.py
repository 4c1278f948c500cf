import gc
from pathlib import Path

import numpy as np
import pytest

from pysim.simulate import FmuStates, FmuValues
from pysim.simulate._library import open_library
from tests.pysim.simulate.text_models import LAG, text_model


@pytest.mark.parametrize("fmi", [2, 3])
def test_states_come_back_and_their_memory_is_used_again(tmp_path: Path, fmi: int) -> None:
    model, number = text_model(LAG, tmp_path, fmi=fmi), np.array([0.0])
    with open_library(model) as library, library.instance() as instance:
        instance.enter_initialisation({}, 0.0, 1.0, None)
        component = instance.component
        states = FmuStates(fmi, component, instance.address)
        u = FmuValues(fmi, [model["u"]], number, instance.address)

        def there(value: float) -> None:
            number[0] = value
            assert u.write(component) == 0

        def seen() -> float:
            assert u.read(component) == 0
            return float(number[0])

        there(1.0)
        status, one = states.save()
        there(2.0)
        _, two = states.save()
        assert status == 0
        for state, expected in ((one, 1.0), (two, 2.0), (one, 1.0)):
            there(9.0)
            assert states.restore(state) == 0
            assert seen() == expected
        address = two.handle.value
        there(3.0)
        _, three = states.save(into=two)
        assert three.handle.value == address
        del two, three
        gc.collect()
        _, four = states.save()
        assert four.handle.value == address
        assert states.restore(four) == 0
        assert seen() == 3.0
        states.free()
