"""The comparison with independent measurements can fail: it sees a strength, a sign or a parameter that is wrong."""

import numpy as np
import pytest

from validation.blind.plant.quantities import Strengths
from validation.blind.proof import parameters_of, read_truth, read_wave, strengths_of


def mean_square(name: str, **wrong: float) -> float:
    told = read_truth()[name]
    strengths = strengths_of(told)
    strengths = strengths._replace(**{field: getattr(strengths, field) * by for field, by in wrong.items()})
    residuals = read_wave(name).residuals(parameters_of(told["parameters"]), strengths)
    return float(np.mean(residuals**2))


@pytest.mark.parametrize(
    ("name", "field"),
    [
        ("bench-02", "coulomb__F_c"),
        ("bench-03", "deadband__u_0"),
        ("bench-06", "lag__T_f"),
        ("bench-07", "bias__F_b"),
        ("bench-15", "offset__u_n"),
    ],
)
def test_the_told_strength_leaves_noise_and_another_does_not(name: str, field: str) -> None:
    assert mean_square(name) == pytest.approx(1.0, abs=4 * np.sqrt(2 / 7502))
    assert mean_square(name, **{field: -1.0 if field in ("bias__F_b", "offset__u_n") else 0.5}) > 1.08


def test_no_effect_needs_none() -> None:
    told = read_truth()["bench-01"]
    assert strengths_of(told) == Strengths()
    assert mean_square("bench-01") == pytest.approx(1.0, abs=4 * np.sqrt(2 / 7502))
    off = parameters_of({**told["parameters"], "tau": told["parameters"]["tau"] * 1.1})
    assert float(np.mean(read_wave("bench-01").residuals(off, Strengths()) ** 2)) > 1.08


def test_two_effects_and_the_old_name_of_a_parameter_are_understood() -> None:
    both = strengths_of(read_truth()["bench-15"])
    assert both == Strengths(offset__u_n=0.012, preload__F_0=90.0)
    assert parameters_of({"K_d": 0.3}).K_D == 0.3
