"""When discrete variables follow the inputs that they depend on, which is when SUBSET.md says."""

import pytest

from tests.cases import Case
from tests.contracts.building import Built
from tests.contracts.fmu import Fmu

FOLLOWING = Case(
    name="following",
    class_name="Following",
    text="""model Following
  input Integer j(start=2);
  output Integer twice = 2*j;
  output Real thrice = 3*j;
end Following;
""",
)


@pytest.fixture
def following(built: Built, fmi: int) -> Fmu:
    return built(FOLLOWING, fmi)


def test_in_co_simulation_with_the_next_step(following: Fmu) -> None:
    with following.open("cs") as instance:
        instance.start()
        instance.step(0.0, 0.1)
        instance.set({"j": 7})
        assert list(instance.get(["twice", "thrice"])) == [4, 21]
        instance.step(0.1, 0.1)
        assert list(instance.get(["twice", "thrice"])) == [14, 21]


def test_in_model_exchange_with_the_next_update(following: Fmu) -> None:
    with following.open("me") as instance:
        instance.start()
        instance.raw.enterEventMode()
        instance.set({"j": 7})
        assert list(instance.get(["twice", "thrice"])) == [4, 21]
        instance.iterate_events()
        assert list(instance.get(["twice", "thrice"])) == [14, 21]
