"""What is wrong with an input or with two names is found as that, and not as turned signs of all that follows it."""

import numpy as np
import pytest

from pysim.identify.data_check import FindingCode
from pysim.nouns.data import Data, load
from pysim.types import MeasuredRecord, Record

TIME = np.arange(1500) / 500
RNG = np.random.default_rng(3)
COMMAND = 0.5 * np.convolve(RNG.normal(size=TIME.size + 49), np.ones(50) / 7, "valid")
NOISE = RNG.normal(size=(TIME.size, 4))
OUTPUTS = ("x", "v", "pA", "pB")
UNITS = {"u": "1", "x": "m", "v": "m/s", "pA": "bar", "pB": "bar"}


class Cylinder:
    """Pressures at the ports go opposite ways, each about its own level.

    Args:
        level: of the second port less the first, Pa.
        follows: whether the simulated pressures move as the measured ones do.
    """

    def __init__(self, level: float, *, follows: bool = True) -> None:
        self.level, self.follows = level, follows

    def simulate(self, log: MeasuredRecord) -> Record:
        assert isinstance(log.data, Record)
        v = 0.2 * np.convolve(log.data["u"], np.exp(-np.arange(200) / 20) / 20)[: TIME.size]
        swing = 4e5 * (v if self.follows else np.roll(v, 400))
        columns = [np.cumsum(v) / 500, v, 5e6 + swing, 5e6 + self.level - 0.6 * swing]
        return Record(TIME, np.column_stack(columns), OUTPUTS, ("m", "m/s", "Pa", "Pa"))


def logged(plant: Cylinder, turned: str = "", swapped: bool = False) -> Data:
    """A log of the plant."""
    drive = load({"t": TIME, "u [1]": COMMAND, "x [m]": COMMAND}, inputs="u", outputs="x", time="t")["log"]
    answer = plant.simulate(drive)
    columns = {"u": COMMAND} | {name: answer[name] for name in OUTPUTS}
    columns |= {name: columns[name] + 0.01 * np.std(columns[name]) * NOISE[:, k] for k, name in enumerate(OUTPUTS)}
    columns |= {"pA": 1e-5 * columns["pA"], "pB": 1e-5 * columns["pB"]}
    if swapped:
        columns |= {"pA": columns["pB"], "pB": columns["pA"]}
    for name in turned.split():
        columns[name] = -columns[name]
    frame = {"t": TIME} | {f"{name} [{UNITS[name]}]": column for name, column in columns.items()}
    return load(frame, inputs="u", outputs=list(OUTPUTS), time="t")


SWAP = 'data = data.rename({"pA": "pB", "pB": "pA"})'


@pytest.mark.parametrize(
    ("level", "turned", "swapped", "lines"),
    [
        (3e6, "", False, []),
        (3e6, "u", False, ['data = data.flip("u")']),
        (3e6, "", True, [SWAP]),
        (0.0, "", True, [SWAP]),  # told by their signs alone
        (3e6, "x v", False, ['data = data.flip("x")', 'data = data.flip("v")']),  # as the pressures do follow
        (3e6, "pA pB", False, ['data = data.flip("pA")', 'data = data.flip("pB")']),
        (3e6, "x", False, ['data = data.flip("x")']),
        (3e6, "x v pA pB", False, [f'data = data.flip("{name}")' for name in OUTPUTS]),
    ],
)
def test_the_cause_is_named_once(level: float, turned: str, swapped: bool, lines: list[str]) -> None:
    data = logged(Cylinder(level), turned, swapped)
    check = data.check(Cylinder(level))
    assert list(check.lines) == lines
    assert len(check.findings) == len(lines)
    for found in check.findings:
        data = data.after(*found.cure)
    assert data.check(Cylinder(level)).ok
    assert all(step_name in repr(check) for step_name in lines)


@pytest.mark.parametrize(
    ("turned", "line"),
    [("u", 'data = data.flip("u", logs=["run2"])'), ("x", 'data = data.flip("x", logs=["run2"])')],
)
def test_a_log_with_another_sign_than_the_others_is_named_once(turned: str, line: str) -> None:
    plant = Cylinder(3e6)
    frames = {}
    for name, own in (("run1", ""), ("run2", turned), ("run3", "")):
        frames[name] = logged(plant, own).to_dataframe().droplevel(0).reset_index()
    data = load(frames, inputs="u", outputs=list(OUTPUTS), time="time [s]")
    check = data.check(plant)
    assert list(check.lines) == [line]
    (found,) = check.findings
    assert data.after(*found.cure).check(plant).ok


@pytest.mark.parametrize("turned", ["u", "v", ""])
def test_an_output_that_follows_too_little_to_tell_its_sign_still_tells_whose_sign_is_turned(turned: str) -> None:
    """The speed follows the model, and the force is as large again for what the model lacks."""

    class Mass:
        def simulate(self, log: MeasuredRecord) -> Record:
            assert isinstance(log.data, Record)
            v = np.convolve(log.data["u"], np.exp(-np.arange(200) / 20) / 20)[: TIME.size]
            return Record(TIME, np.column_stack([v, np.gradient(v, TIME)]), ("v", "F"), ("m/s", "N"))

    drive = load({"t": TIME, "u [1]": COMMAND, "v [m/s]": COMMAND}, inputs="u", outputs="v", time="t")["log"]
    answer = Mass().simulate(drive)
    own, rest = answer["F"], np.roll(answer["F"], 700)
    rest = rest - own * (rest @ own) / (own @ own)
    force = own + 1.2 * rest * np.std(own) / np.std(rest)  # a correlation of 0.64
    columns = {"u [1]": COMMAND, "v [m/s]": answer["v"] + 1e-3 * NOISE[:, 0], "F [N]": force}
    frame = {"t": TIME} | {name: -own if name[0] == turned else own for name, own in columns.items()}
    data = load(frame, inputs="u", outputs=["v", "F"], time="t")
    assert list(data.check(Mass()).lines) == ([f'data = data.flip("{turned}")'] if turned else [])


def test_levels_tell_a_swap_though_the_model_does_not_follow() -> None:
    poor = Cylinder(3e6, follows=False)
    assert logged(Cylinder(3e6)).check(poor).ok
    (found,) = logged(Cylinder(3e6), swapped=True).check(poor).findings
    assert found.code is FindingCode.SWAPPED
    assert {found.values["signal"], found.values["other"]} == {"pA", "pB"}
