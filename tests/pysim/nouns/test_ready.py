"""A log as a bench leaves it becomes ready with the lines that `check` proposes, and with nothing else."""

from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path

import numpy as np
import pytest

import pysim
from pysim.identify.data_check import FindingCode
from pysim.io import read_dataset
from pysim.nouns.data import Data, load
from pysim.types import MeasuredRecord, Record
from tests.toy import library

RATE = 200.0
TIME = np.arange(2000) / RATE
FORCE = 400 * np.convolve(np.random.default_rng(11).normal(size=TIME.size + 39), np.ones(40) / 40, "valid")  # N
LAG = np.convolve(FORCE, np.exp(-np.arange(400) / 30) / 30)[: TIME.size]
PLACE, SPEED, PRESSURE = 1e-4 * LAG, 2e-5 * np.gradient(LAG, TIME), 1e6 + 3e3 * LAG
MODEL = Record(TIME, np.column_stack([PLACE, SPEED, PRESSURE]), ("x", "v", "p"), ("m", "m/s", "Pa"))


def log_file(folder: Path) -> Path:
    """Date-times with a zone, an empty cell, a turned sign, volts, an outlier, and a speed in mm/s said to be m/s."""
    rng = np.random.default_rng(12)
    x = -1e3 * PLACE + rng.normal(scale=0.02, size=TIME.size)  # mm, turned
    p = 1e-6 * PRESSURE * 2 + 0.5 + rng.normal(scale=1e-4, size=TIME.size)  # V
    v = 1e3 * SPEED + rng.normal(scale=0.1, size=TIME.size)
    x[700] += 40
    begin = datetime(2026, 3, 1, 14, 5, tzinfo=UTC)
    lines = ["timestamp,F [N],x [mm],v [m/s],p [V]"]
    for k, t in enumerate(TIME):
        moment = begin + timedelta(seconds=t)
        cells = [f"{moment:%Y-%m-%dT%H:%M:%S.%f}+00:00", *map(repr, map(float, (FORCE[k], x[k], v[k], p[k])))]
        cells[2] = "" if k == 300 else cells[2]
        lines.append(",".join(cells))
    path = folder / "run1.csv"
    path.write_text("\n".join(lines))
    return path


@pytest.fixture
def data(tmp_path: Path) -> Data:
    return load(log_file(tmp_path), inputs="F", outputs=["x", "v", "p"])


def test_the_lines_of_the_check_make_it_ready(data: Data, tmp_path: Path) -> None:
    before = (tmp_path / "run1.csv").read_bytes()
    found = data.check({"run1": MODEL})
    assert [one.code for one in found.findings] == [
        *(FindingCode.SIGN, FindingCode.FACTOR, FindingCode.QUANTITY),
        FindingCode.OUTLIERS,
    ]
    assert len(found.lines) == 4
    assert "In run1.csv, x lacks 1 sample. It is not compared." in repr(found)
    own = {"data": data}
    for line in found.lines:
        exec(line, own)
    ready = own["data"]
    assert ready.check({"run1": MODEL}).ok
    log = ready.dataset.records[0].data
    assert isinstance(log, Record)
    assert log.units == ("N", "m", "m/s", "Pa")
    np.testing.assert_allclose(log["x"], np.where(np.isin(np.arange(TIME.size), (300, 700)), np.nan, PLACE), atol=1e-4)
    np.testing.assert_allclose(log["v"], SPEED, atol=1e-3)
    np.testing.assert_allclose(log["p"], PRESSURE, atol=0.02 * np.ptp(PRESSURE))
    ready.save(tmp_path / "ready")
    saved = read_dataset(tmp_path / "ready").records[0].data
    assert isinstance(saved, Record)
    np.testing.assert_allclose(saved.values, log.values, rtol=1e-9, atol=1e-9)
    assert (tmp_path / "run1.csv").read_bytes() == before


def test_the_check_can_be_read(data: Data) -> None:
    shown = repr(data.check({"run1": MODEL}))
    assert len(shown) < 2000
    assert all(line in shown for line in data.check({"run1": MODEL}).lines)


def test_steps_of_a_finding_can_be_applied_as_they_are(data: Data) -> None:
    for finding in data.check().findings:
        data = data.after(*finding.cure)
    assert data.check().ok


class Plant:
    """What answers to a log."""

    def simulate(self, log: MeasuredRecord) -> Record:
        assert isinstance(log.data, Record)
        assert log.data.names == ("F", "cylinder.x", "v", "p")
        assert np.isfinite(log.data["F"]).all()
        assert np.flatnonzero(np.isnan(log.data["cylinder.x"])).tolist() == [300]
        return replace(MODEL, names=("cylinder.x", "v", "p"))


def test_a_model_is_simulated_on_the_logs(data: Data, tmp_path: Path) -> None:
    path = tmp_path / "run1.csv"
    called = load(path, inputs="F", outputs=["x", "v", "p"], variables={"x": "cylinder.x"})
    assert called.check(Plant()).lines == data.check({"run1": MODEL}).lines


@pytest.mark.parametrize("seed", range(100, 120))
def test_clipped_stretches_are_left_out(seed: int) -> None:
    """Noise breaks some of them in two; what is left between the parts would be too short for a log."""
    y = np.sin(2 * np.pi * 0.2 * TIME) + np.random.default_rng(seed).normal(scale=0.01, size=TIME.size)
    clipped = load({"t": TIME, "F [N]": FORCE, "x [mm]": np.minimum(y, 0.8)}, inputs="F", outputs="x", time="t")
    (found,) = clipped.check().findings
    assert found.code is FindingCode.CLIPPED
    own = {"data": clipped}
    for line in clipped.check().lines:
        exec(line, own)
    assert own["data"].check().ok
    assert len(found.cure) == 2  # crests
    assert len(own["data"]) == 3  # one more stretch than is left out


def test_a_unit_that_keeps_the_model_from_being_simulated_is_a_finding(tmp_path: Path) -> None:
    force = load({"t": TIME, "F [V]": FORCE, "x [m]": PLACE}, inputs="F", outputs="x", time="t")
    mass = pysim.model("Toy.Mass", library=library())
    (found,) = force.check(mass).findings
    assert (found.code, found.values["signal"], found.cure) == (FindingCode.QUANTITY, "F", ())
    said = " ".join(repr(force.check(mass)).split())
    typed = said[said.index("data = data.scale(") :].replace("...", "1.0")
    own = {"data": force}
    exec(typed, own)
    assert FindingCode.QUANTITY not in {one.code for one in own["data"].check(mass).findings}
    (tmp_path / "Lag.mo").write_text(
        'model Lag parameter Real T(unit="s") = 0.05; input Real u(unit="1"); '
        'output Real y(unit="%", start=0, fixed=true); equation T*der(y) = 100*u - y; end Lag;'
    )
    lag = pysim.model(tmp_path / "Lag.mo")
    y = lag.simulate(TIME[-1], dt=1 / RATE, u=FORCE / 400).record["y"]
    shares = load({"t": TIME, "u [%]": FORCE / 4, "y [1]": y / 100}, inputs="u", outputs="y", time="t")
    assert shares.check(lag).lines == (
        'data = data.scale("u", factor=0.01, unit="1", of="%")',
        'data = data.scale("y", factor=100, unit="%", of="1")',
    )
    for found in shares.check(lag).findings:
        shares = shares.after(*found.cure)
    assert shares.check(lag).ok
    np.testing.assert_allclose(shares["log"].data["u"], FORCE / 400, rtol=1e-12)


def test_what_is_measured_and_what_is_driven_is_held_against_the_model() -> None:
    """Otherwise the first word of it would be a fit that refuses the data, or none at all of an input that stands."""
    mass = pysim.model("Toy.Mass", library=library())
    columns = {"t": TIME, "F [N]": FORCE, "x [m]": PLACE, "T [degC]": 20 + PLACE}
    whole = load(columns, inputs="F", outputs=["x", "T"], time="t")
    names = {FindingCode.NOT_IN_MODEL, FindingCode.NOT_DRIVEN}
    (found,) = [one for one in whole.check(mass).findings if one.code in names]
    assert (found.code, found.values["signal"]) == (FindingCode.NOT_IN_MODEL, "T")
    said = " ".join(repr(whole.check(mass)).split())
    assert "the model has no T, so a fit will refuse it; rename it to one of x, v" in said
    still = load(columns, inputs="F", outputs=["x", "T"], time="t", variables={"x": "m"})
    assert {one.values["signal"] for one in still.check(mass).findings} == {"x", "T"}  # m is a parameter
    other = load({"t": TIME, "push [N]": FORCE, "x [m]": PLACE}, inputs="push", outputs="x", time="t")
    codes = {one.code: one.values["signal"] for one in other.check(mass).findings}
    assert codes == {FindingCode.NOT_IN_MODEL: "push", FindingCode.NOT_DRIVEN: "F"}
    assert FindingCode.NOT_DRIVEN not in {one.code for one in other.check(mass.set(F=1.0)).findings}
    right = load({"t": TIME, "F [N]": FORCE, "x [m]": PLACE}, inputs="F", outputs="x", time="t")
    assert not names & {one.code for one in right.check(mass).findings}


def test_a_slow_log_is_loaded_in_ms_as_its_finding_says() -> None:
    columns = {"time": 1e3 * TIME, "F [N]": FORCE, "x [m]": PLACE}
    slow = load(columns, inputs="F", outputs="x")
    (found,) = slow.check().findings
    assert found.code is FindingCode.SLOW_CLOCK
    said = " ".join(repr(slow.check()).split())
    units = eval(said[said.index("units={") + 6 : said.index("}") + 1])
    cured = load(columns, inputs="F", outputs="x", units=units)
    assert cured.check().ok
    assert cured["log"].data.time[-1] == pytest.approx(TIME[-1])
