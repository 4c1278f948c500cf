"""Each example lacks one effect, which the diagnosis finds, with the size that the machine has."""

import pytest

import pysim
from pysim.nouns.example import EXAMPLES


@pytest.mark.slow
@pytest.mark.parametrize("name", ["drive", "heater"])
def test_what_the_model_lacks_is_found_in_size(name: str) -> None:
    own = EXAMPLES[name]
    data = pysim.example(name)
    assert "0 warnings, ready to use" in str(data.check())
    why = pysim.diagnose(pysim.model(own.model, library=own.libraries), data)
    effect, size, value = own.lacks
    assert why.verdict == effect
    found = next(row for row in why.effects if row["parameter"] == size)
    assert found["95 % from"] < value < found["to"]
    assert why.steps["held out"][-1] == pytest.approx(1.0, abs=0.05)


def test_there_is_no_other_example() -> None:
    with pytest.raises(pysim.BadInput, match="there is no 'crane'; write pump or drive or heater"):
        pysim.example("crane")
