from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from pysim.bench import read_plan
from pysim.diagnose.candidate_tests import candidate_tests
from pysim.types import BadInput, Experiment, MeasuredSignal
from tests.pysim.diagnose.toy import base, measured

DATA = measured(1)
LARGEST = max(np.abs(record.data["F"]).max() for record in DATA.logs())


def soon(run: Experiment) -> float:
    """At rest 2.45 s after a step."""
    assert run.inputs["F"].value(np.array([0.1, 20.0])).tolist() == pytest.approx([LARGEST * 0.75] * 2)
    return 2.46


def test_no_test_goes_beyond_what_was_run() -> None:
    model = base()
    tests = candidate_tests(DATA, soon, model)
    assert len({(t.offset, t.amplitude, t.frequency) for t in tests}) == len(tests)
    for test in tests:
        run = test.experiment(model, ("x",), {})
        assert run.times.size == test.samples >= 300
        assert test.command.onset == 1 + 2.5
        assert (
            np.abs(run.inputs["F"].value(np.linspace(0, test.seconds, 2000))).max() <= LARGEST * 1.3
            if not test.periods
            else LARGEST * (1 + 1e-9)
        )
    assert {t.offset > 0 for t in tests} == {True, False}
    assert {t.periods > 0 for t in tests} == {True, False}


def test_a_command_of_one_sign_stays_so() -> None:
    rows = replace(DATA.records[0].data, values=np.abs(DATA.records[0].data.values))
    data = replace(DATA, records=(replace(DATA.records[0], data=rows),))
    assert all(t.offset > 0 for t in candidate_tests(data, lambda run: 2.0, base()))


def test_the_plan_is_the_test(tmp_path: Path) -> None:
    head = ["[plan]", 'name = "p"', "[signals.F]", 'role = "input"', 'unit = "N"', 'quantity = "force"']
    head += ["[signals.x]", 'role = "output"', 'unit = "m"', 'quantity = "position"', "[logging]", "rate = 50"]
    for test in candidate_tests(DATA, soon, base()):
        path = tmp_path / "plan.toml"
        path.write_text("\n".join([*head, *test.plan_rows(("x",), "one")]))
        (run,) = read_plan(path).runs()
        times = np.linspace(0, test.seconds, 500)
        assert run.log_from == pytest.approx(test.log_from)
        assert run.command.end == pytest.approx(test.command.end, rel=1e-6)
        wanted, made = test.command.signal().value(times), run.command.signal().value(times)
        assert made == pytest.approx(wanted, abs=2e-4 * np.abs(wanted).max())


def test_two_commands_are_refused() -> None:
    other = MeasuredSignal("G", "input", "N", "", "F")
    with pytest.raises(BadInput, match="'toy': a next test needs one command"):
        candidate_tests(replace(DATA, signals=(*DATA.signals, other)), soon, base())
