"""The session: the tests of the independent measurements, sample for sample."""

from pathlib import Path

import numpy as np

from validation.blind.plant.programme import RATE, programme

MEASURED = Path(__file__).parents[4] / "validation" / "measurements" / "bench-01"


def test_the_same_logs_of_the_same_length() -> None:
    files = {path.relative_to(MEASURED).as_posix() for path in MEASURED.rglob("*.txt")}
    assert {test.file for test in programme()} == files
    for test in programme():
        rows = len((MEASURED / test.file).read_text(encoding="utf-8").splitlines()) - 1
        assert int(np.floor(test.length * RATE + 1e-6)) + 1 == rows


def test_sines_and_chirp_command_what_was_commanded_there() -> None:
    for test in programme():
        if test.kind == "stochastic" or (test.frequency is not None and test.frequency < 4):
            continue
        measured = np.loadtxt(MEASURED / test.file, skiprows=1)[:, 1]
        command = test.command(seed=1)
        first = round(command.start / 20e-6) // command.every
        step = round(1 / RATE / 20e-6) // command.every
        assert np.abs(command.level[first::step][: measured.size] - measured).max() < 6e-6
