"""What begins just after the start happens at the first event, not while the model is initialised."""

import pytest

from tests.cases import Case
from tests.contracts.building import Built

BEGINNING = Case(
    name="beginning",
    class_name="Beginning",
    text="""model Beginning
  parameter Real T = 0;
  output Integer once(start=0, fixed=true);
  output Integer twice(start=0, fixed=true);
  output Integer never(start=0, fixed=true);
  output Real x(start=0, fixed=true);
equation
  der(x) = if time > T then 1 else 0;
  when time > T then
    once = pre(once) + 1;
  end when;
  when {initial(), time > T} then
    twice = pre(twice) + 1;
  end when;
  when time >= T then
    never = pre(never) + 1;
  end when;
end Beginning;
""",
)


def test_a_condition_of_time_rises_at_the_start(built: Built, fmi: int) -> None:
    with built(BEGINNING, fmi).open("cs") as instance:
        instance.start()
        instance.step(0.0, 1.0)
        found = instance.get(["once", "twice", "never", "x"])
    assert found == pytest.approx([1, 2, 0, 1.0], abs=1e-12)
