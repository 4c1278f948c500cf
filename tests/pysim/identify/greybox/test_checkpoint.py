import json
from pathlib import Path

import numpy as np
import pytest

from pysim.identify.greybox import checkpoint
from pysim.identify.greybox.checkpoint import LINES, STATE, Checkpoint
from pysim.identify.greybox.interior_point import InteriorPoint
from pysim.identify.greybox.least_squares import GaussNewton
from pysim.identify.greybox.optimiser import Optimiser
from pysim.identify.greybox.search import Tried, search
from pysim.types import BadInput
from tests.pysim.identify.greybox.functions import beside_a_bent_state, evaluating, rosenbrock, rosenbrock_slopes, space


class Killed(Exception):
    """Stands for the end of the process."""


def killing(after: int) -> object:
    def progress(tried: Tried) -> None:
        if tried.tried == after:
            raise Killed

    return progress


@pytest.mark.parametrize(
    ("optimiser", "squares"), [(GaussNewton(tolerance=1e-12), True), (InteriorPoint(tolerance=1e-5), False)]
)
@pytest.mark.parametrize("after", [0, 1, 4])
def test_a_resumed_search_ends_as_one_that_was_never_killed(
    tmp_path: Path, optimiser: Optimiser, squares: bool, after: int
) -> None:
    s = space([-1.2, 1.0], [-3.0, -3.0], [3.0, 3.0])
    evaluate = evaluating(rosenbrock, rosenbrock_slopes, squares=squares)
    whole = search(evaluate, optimiser, s, s.start, squares=squares, checkpoint=Checkpoint(tmp_path / "whole", "a"))
    journal = Checkpoint(tmp_path / "killed", "a")
    with pytest.raises(Killed):
        search(evaluate, optimiser, s, s.start, squares=squares, checkpoint=journal, progress=killing(after))
    with (tmp_path / "killed" / LINES).open("a") as file:
        file.write('{"iteration": ')  # the line that was being written
    resumed = search(evaluate, optimiser, s, s.start, squares=squares, checkpoint=journal, resume=True)
    assert np.array_equal(resumed.best.x, whole.best.x)
    assert (resumed.tried, resumed.best.cost, resumed.first_cost) == (whole.tried, whole.best.cost, whole.first_cost)
    lines = [(tmp_path / name / LINES).read_text() for name in ("whole", "killed")]
    assert lines[0] == lines[1]


def test_a_line_per_point_says_what_was_tried(tmp_path: Path) -> None:
    s = space([-1.2, 1.0])
    evaluate = evaluating(rosenbrock, rosenbrock_slopes, bad=lambda x: x[1] < -1)
    state = search(
        evaluate, GaussNewton(radius=8.0), s, s.start, squares=True, checkpoint=Checkpoint(tmp_path / "log", "a")
    )
    rows = [json.loads(line) for line in (tmp_path / "log" / LINES).read_text().splitlines()]
    assert [row["iteration"] for row in rows] == list(range(state.tried + 1))
    assert rows[0]["parameters"] == {"p0": -1.2, "p1": 1.0}
    assert rows[-1]["outcome"] == "converged"
    bad = [row for row in rows if row["cost"] is None]
    assert bad
    assert all("does not run here" in row["trouble"] and not row["taken"] for row in bad)


def test_a_finished_search_is_not_run_again(tmp_path: Path) -> None:
    s = space([-1.2, 1.0])
    journal = Checkpoint(tmp_path, "a")
    first = search(
        evaluating(rosenbrock, rosenbrock_slopes), GaussNewton(), s, s.start, squares=True, checkpoint=journal
    )

    def never(x: np.ndarray, states: object = ()) -> object:
        raise AssertionError("no point should be tried")

    again = search(never, GaussNewton(), s, s.start, squares=True, checkpoint=journal, resume=True)
    assert np.array_equal(again.best.x, first.best.x)
    assert again.outcome is first.outcome


def test_a_log_of_another_fit_is_refused(tmp_path: Path) -> None:
    s = space([-1.2, 1.0])
    evaluate = evaluating(rosenbrock, rosenbrock_slopes)
    search(evaluate, GaussNewton(), s, s.start, squares=True, checkpoint=Checkpoint(tmp_path, "a"))
    with pytest.raises(BadInput, match=r"state\.npz belongs to another fit: other .*; repeat the command"):
        search(evaluate, GaussNewton(), s, s.start, squares=True, checkpoint=Checkpoint(tmp_path, "b"), resume=True)
    assert (tmp_path / STATE).is_file()


def test_steps_of_initial_states_are_gone_on_with(tmp_path: Path) -> None:
    s, optimiser = space([-5.0]), GaussNewton(radius=10.0)
    whole = search(beside_a_bent_state, optimiser, s, s.start, squares=True)
    journal = Checkpoint(tmp_path, "a")
    with pytest.raises(Killed):
        search(beside_a_bent_state, optimiser, s, s.start, squares=True, checkpoint=journal, progress=killing(3))
    resumed = search(beside_a_bent_state, optimiser, s, s.start, squares=True, checkpoint=journal, resume=True)
    assert whole.tried > 4
    assert (resumed.tried, resumed.best.cost) == (whole.tried, whole.best.cost)
    assert resumed.best.carried.states[0] == whole.best.carried.states[0]


def test_a_state_of_another_version_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    s, journal = space([-5.0]), Checkpoint(tmp_path, "a")
    search(beside_a_bent_state, GaussNewton(), s, s.start, squares=True, checkpoint=journal)
    monkeypatch.setattr(checkpoint, "_PLAIN", (*checkpoint._PLAIN, "gain"))
    with pytest.raises(BadInput, match="another fit"):
        journal.load()
