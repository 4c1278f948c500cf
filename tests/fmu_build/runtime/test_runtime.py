"""The C tests in fmu_build/runtime/test: each program with each model it can judge."""

from collections.abc import Callable

import pytest

MODELS = ("oscillator", "ball", "sampled", "delayed", "loop", "van_der_pol", "troubled", "nonautonomous")


@pytest.mark.parametrize(
    ("program", "model"),
    [
        ("test_linear", "oscillator"),
        ("test_order", "nonautonomous"),
        ("test_exchange", "oscillator"),
        ("test_integrator", "oscillator"),
        ("test_ball", "ball"),
        ("test_sampled", "sampled"),
        ("test_delayed", "delayed"),
        ("test_loop", "loop"),
        ("test_newton", "loop"),
        ("test_van_der_pol", "van_der_pol"),
        ("test_troubled", "troubled"),
    ],
)
def test_against_known_answers(c_test: Callable[..., str], program: str, model: str) -> None:
    c_test(program, model)


@pytest.mark.parametrize("model", MODELS)
def test_restored_states_repeat_bit_for_bit(c_test: Callable[..., str], model: str) -> None:
    c_test("test_states", model)


@pytest.mark.parametrize("model", MODELS)
def test_abuse_ends_in_a_status(c_test: Callable[..., str], model: str) -> None:
    c_test("test_abuse", model)


@pytest.mark.parametrize("model", MODELS)
def test_abuse_by_fmi_3_ends_in_a_status(c_test: Callable[..., str], model: str) -> None:
    c_test("test_abuse3", model, fmi=3)


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize(("program", "fmi"), [("test_instances", 2), ("test_instances3", 3)])
def test_instances_leave_not_a_byte(c_test: Callable[..., str], model: str, program: str, fmi: int) -> None:
    c_test(program, model, fmi=fmi)


def test_fmi_3_events_and_early_return(c_test: Callable[..., str]) -> None:
    c_test("test_fmi3", "ball", fmi=3)


@pytest.mark.parametrize("model", ["oscillator", "loop"])
def test_adjoint_and_directional_derivatives_agree(c_test: Callable[..., str], model: str) -> None:
    c_test("test_adjoint", model, fmi=3)
