"""Equations without a solution are named by their unknown, with its value and the time."""

import pytest
from fmpy.fmi1 import FMICallException

from tests.cases import Case
from tests.contracts.building import Built


def case(name: str, body: str) -> Case:
    return Case(name=name.lower(), class_name=name, text=f"model {name}\n{body}\nend {name};\n")


def reasons(built: Built, unsolvable: Case) -> str:
    """What is logged until initialisation or a run of 2 s fails."""
    with built(unsolvable, 3).open("cs") as instance:
        with pytest.raises(FMICallException):
            instance.start().step(0.0, 2.0)
        return "\n".join(instance.messages)


@pytest.mark.parametrize(
    ("unsolvable", "expected"),
    [
        (case("Flat", "Real x; equation 0 = x^2 - 4;"), "are singular at x = 0; if there is one, give x another"),
        (case("Rootless", "Real x; Real y; equation 0 = sqrt(x - 1) - y; y^3 + sin(x) = 2;"), "have no value at x = 0"),
        (
            case(
                "Unguessed",
                "parameter Real p(fixed=false); Real x(start=1); initial equation p^2 = x; x = 1; equation der(x) = p;",
            ),
            "the initial equations are singular at p = 0",
        ),
        (
            case("Folding", "Real x(start=1); Real z(start=1, fixed=true); equation x^2 = z; der(z) = -1;"),
            "No solution found at time 1",
        ),
    ],
    ids=lambda value: value.name if isinstance(value, Case) else "",
)
def test_a_failed_solution_names_its_unknown(built: Built, unsolvable: Case, expected: str) -> None:
    assert expected in reasons(built, unsolvable)
