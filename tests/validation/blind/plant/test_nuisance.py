"""Nuisances: seeded, of the size and memory they claim."""

import numpy as np
import pytest

from validation.blind.plant.nuisance import KINDS, Nuisance, deviation_told, draw_nuisance, noise


def test_coloured_noise_has_its_size_and_memory() -> None:
    nuisance = Nuisance(coloured=1.0, memory=0.02)
    drawn = noise(200_000, 0.1, nuisance, 0.004, np.random.default_rng(1))
    assert drawn.std() == pytest.approx(deviation_told(0.1, nuisance), rel=0.02)
    next_to = np.mean(drawn[1:] * drawn[:-1])
    assert next_to == pytest.approx(0.1**2 * np.exp(-0.2), rel=0.05)


def test_white_noise_has_no_memory() -> None:
    drawn = noise(200_000, 0.1, Nuisance(), 0.004, np.random.default_rng(2))
    assert drawn.std() == pytest.approx(0.1, rel=0.01)
    assert abs(np.mean(drawn[1:] * drawn[:-1])) < 1e-4


@pytest.mark.parametrize("kind", KINDS)
def test_each_kind_changes_its_own_numbers_alone(kind: str) -> None:
    fields = {"coloured": {"coloured", "memory"}, "start": {"hold", "before"}}.get(kind, {kind})
    drawn, off = draw_nuisance((kind,), np.random.default_rng(3)), Nuisance()
    changed = {name for name in vars(off) if getattr(drawn, name) != getattr(off, name)}
    assert changed == fields


def test_none_is_off_and_an_unknown_kind_is_refused() -> None:
    assert draw_nuisance((), np.random.default_rng(1)) == Nuisance()
    with pytest.raises(ValueError, match="no nuisance called drift"):
        draw_nuisance(("drift",), np.random.default_rng(1))
