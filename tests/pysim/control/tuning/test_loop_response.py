import math

import numpy as np
import pytest

from pysim.control.tuning import Plant, load_pressure_plant, loop_response
from pysim.types import BadInput

INTEGRATOR = Plant((1.0,), (1.0, 0.0))


def test_pi_on_an_integrator_in_closed_form() -> None:
    """Step answer of (2s + 1)/(s + 1)^2, and (of a disturbance) of s/(s + 1)^2; sampling adds terms of the size dt."""
    step = loop_response(INTEGRATOR, 2.0, 2.0, dt=1e-4, stop=8.0)
    t = step.time
    assert step.output == pytest.approx(1 + (t - 1) * np.exp(-t), abs=2e-4)
    hit = loop_response(INTEGRATOR, 2.0, 2.0, dt=1e-4, stop=8.0, reference=0.0, disturbance=1.0)
    assert hit.output == pytest.approx(t * np.exp(-t), abs=2e-4)
    assert hit.command[-1] == pytest.approx(-1.0, abs=5e-3)


def test_the_plant_is_discretised_exactly() -> None:
    """A lag under a gain alone (the integral takes 10^9 s) follows a geometric series."""
    dt, gain = 0.05, 0.7
    found = loop_response(Plant((2.0,), (0.5, 1.0)), gain, 1e9, dt=dt, stop=1.0)
    pole = math.exp(-dt / 0.5)
    loop = pole - 2 * gain * (1 - pole)
    k = np.arange(found.time.size)
    assert found.output == pytest.approx(2 * gain / (1 + 2 * gain) * (1 - loop**k), rel=1e-6)


def test_dead_time_comes_first() -> None:
    found = loop_response(Plant((1.0,), (1.0, 0.0), delay=0.03), 1.0, 1.0, dt=0.01, stop=0.2)
    assert found.output[:4].tolist() == [0, 0, 0, 0]
    assert found.output[4] == pytest.approx(0.01)
    assert found.command[0] == 1.0


def test_a_disturbance_takes_the_dead_time_of_the_command_it_is_added_to() -> None:
    plant = Plant((1.0,), (1.0, 0.0), delay=0.03)
    found = loop_response(plant, 1.0, 1.0, dt=0.01, stop=0.2, reference=0.0, disturbance=1.0)
    assert found.output[:4].tolist() == [0, 0, 0, 0]
    assert found.output[4] == pytest.approx(0.01)


def test_load_pressure_comes_to_rest_without_error() -> None:
    found = loop_response(load_pressure_plant(), 1.98e-9, 0.03, dt=1e-3, stop=2.0)
    assert found.output[-1] == pytest.approx(1.0, abs=1e-6)


def test_parts_of_a_step_look_closer_at_the_same_loop() -> None:
    plant = load_pressure_plant().delayed(0.02)
    coarse = loop_response(plant, 1.98e-9, 0.03, dt=0.01, stop=1.0)
    fine = loop_response(plant, 1.98e-9, 0.03, dt=0.01, stop=1.0, parts=5)
    assert fine.time[::5] == pytest.approx(coarse.time)
    assert fine.output[::5] == pytest.approx(coarse.output, abs=1e-9)
    assert np.ptp(fine.command[:-1].reshape(-1, 5), axis=1).max() == 0.0


@pytest.mark.parametrize("parts", [1, 2, 5])
def test_dead_time_ends_within_a_step(parts: int) -> None:
    """k t of an integrator under a gain of 1, from the end of the dead time on, at all ends of the parts."""
    plant = Plant((1.0,), (1.0, 0.0), delay=0.0137)
    found = loop_response(plant, 1.0, 1e9, dt=0.01, stop=0.02, parts=parts)
    assert found.output == pytest.approx(np.maximum(found.time - 0.0137, 0.0), abs=1e-12)


def test_a_plant_that_answers_at_once_is_read_before_the_command_is_written() -> None:
    """A gain under a gain alone: each step answers to the error that the last one left."""
    g, K_p = 2.0, 0.3
    found = loop_response(Plant((g,), (1.0,)), K_p, 1e9, dt=0.1, stop=2.0)
    k = np.arange(found.time.size)
    assert found.output == pytest.approx(g * K_p / (1 + g * K_p) * (1 - (-g * K_p) ** k), rel=1e-6)


def test_what_answers_at_once_in_part_in_closed_form() -> None:
    """A disturbance passes (2 s + 1)/(0.5 s + 1) hardly controlled: a jump to 4, and down to 1; dead time ahead."""
    lead = Plant((2.0, 1.0), (0.5, 1.0))
    found = loop_response(lead, 1e-12, 1.0, dt=0.01, stop=2.0, reference=0.0, disturbance=1.0)
    assert found.output[0] == 0
    assert found.output[1:] == pytest.approx(1 + 3 * np.exp(-found.time[1:] / 0.5))
    late = loop_response(lead.delayed(0.03), 1e-12, 1.0, dt=0.01, stop=2.0, reference=0.0, disturbance=1.0)
    assert late.output[3:] == pytest.approx(found.output[:-3])


def test_a_loop_that_goes_off_ends_as_numbers() -> None:
    found = loop_response(INTEGRATOR, 50.0, 1.0, dt=0.1, stop=1e3)
    assert np.isfinite(found.output).all()
    assert 1e90 < np.abs(found.output).max() < 1e100
    assert found.time.size == found.output.size == found.command.size < 1000


def test_what_cannot_be_stepped_is_refused() -> None:
    with pytest.raises(BadInput, match="0 < dt < stop"):
        loop_response(INTEGRATOR, 1.0, 1.0, dt=1.0, stop=0.5)
    with pytest.raises(BadInput, match="give 1 or more"):
        loop_response(INTEGRATOR, 1.0, 1.0, dt=0.1, stop=0.5, parts=0)
