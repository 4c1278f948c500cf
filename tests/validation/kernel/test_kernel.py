"""How errors of runs and slopes are counted, on made-up references; and one model against CVODE."""

import numpy as np
import pytest

from validation.kernel.compared import compared, jumps, off, off_slopes
from validation.kernel.reference import Reference, reference
from validation.kernel.subjects import own

TIMES = np.linspace(0.0, 1.0, 101)


def made_up(values: np.ndarray, slopes: np.ndarray, left_open: float = 0.0) -> Reference:
    """One signal of nominal value 1 and one parameter."""
    columns, by = values[:, None], slopes[:, None, None]
    names = np.array(["x"])
    nothing = np.full_like(by, left_open)
    return Reference(
        TIMES, names, columns, TIMES, np.array(["p"]), by, nothing, np.ones(1), np.array([columns]), np.ones(1)
    )


def test_an_error_counts_over_size_and_nominal_value() -> None:
    known = made_up(3.0 * np.sin(2 * np.pi * TIMES), np.ones(101))
    ours = known.values.copy()
    ours[40] += 0.02
    assert off(ours, known) == pytest.approx([0.02 / 4.0])


def test_at_a_jump_either_side_is_right_and_nothing_else() -> None:
    step = np.where(TIMES > 0.505, 1.0, 0.0)
    assert jumps(step, 1.0) == [50]
    known = made_up(step, np.ones(101))
    late = np.where(TIMES > 0.515, 1.0, 0.0)[:, None]  # sees the event a row later
    assert off(late, known) == 0.0
    assert off(late + 0.1, known) == pytest.approx(0.05)
    assert off(np.where(TIMES > 0.545, 1.0, 0.0)[:, None], known) == 0.5  # four rows late is late


def test_slopes_count_over_the_largest_and_beyond_what_is_open() -> None:
    slope = 2.0 * np.cos(2 * np.pi * TIMES)
    assert off_slopes((slope + 0.1)[:, None, None], made_up(slope, slope), False) == pytest.approx(0.05)
    assert off_slopes((slope + 0.1)[:, None, None], made_up(slope, slope, 0.02), False) == pytest.approx(0.02)
    few = slope.copy()
    few[:3] += 1.0  # under 5 percent of the rows
    assert off_slopes(few[:, None, None], made_up(slope, slope), True) == 0.0
    assert off_slopes(few[:, None, None], made_up(slope, slope), False) == pytest.approx(0.5)


@pytest.mark.slow
def test_the_spool_agrees_with_cvode_and_its_reference_is_stored(tmp_path, monkeypatch) -> None:
    subject = next(one for one in own() if one.name == "Validation.SpoolStep")
    first = reference(subject, tmp_path)
    monkeypatch.setattr("validation.kernel.reference._made", None)  # a second one would fail
    assert np.array_equal(reference(subject, tmp_path).slopes, first.slopes)
    monkeypatch.setattr("validation.kernel.compared.reference", lambda _: first)
    found = compared(subject)
    assert set(found.by) == {"spool.omega_v", "spool.zeta_v"}
    assert max(found.rodas, found.esdirk) < 10
    assert found.slopes < 1e-4
    wrong = Reference(**{**vars(first), "slopes": 1.1 * first.slopes})
    monkeypatch.setattr("validation.kernel.compared.reference", lambda _: wrong)
    assert compared(subject).slopes > 0.05
