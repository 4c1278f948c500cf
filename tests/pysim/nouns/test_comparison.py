"""Models held against measurements: the numbers, log by log, and where they are worst."""

from dataclasses import replace

import numpy as np
import pytest

import pysim
from pysim.diagnosis.settings import Settings
from pysim.nouns.diagnosis import Diagnosis
from pysim.nouns.fit import Fit
from pysim.nouns.model import Model
from pysim.present.notes import USES
from pysim.types import BadInput, Dataset, MeasuredRecord, MeasuredSignal, Record
from tests.pysim.nouns.conftest import FRICTION, TRUE
from tests.toy import measured


def truth(mass: Model) -> Model:
    return mass.with_effects("toy.friction").set(**TRUE, **{"force.F_c": FRICTION})


def test_the_plant_itself_leaves_the_noise(mass: Model, data: Dataset) -> None:
    found = pysim.compare(truth(mass), data)
    assert found.table["x noise"] == pytest.approx([1.0, 1.0], abs=0.06)  # 600 samples: 0.03 is one standard deviation
    assert found.table["rms"] == pytest.approx([1.0, 1.0], abs=0.06)  # mm
    assert found.table["unit"] == ("mm", "mm")
    assert min(found.table["fit %"]) > 99.7


def test_numbers_are_those_of_their_definitions(mass: Model, data: Dataset) -> None:
    """Against a run from rest of one's own: the logs begin at rest, and initial="rest" compares them so."""
    found = pysim.compare(mass, data, initial="rest")
    for log, row in zip(data.records, found.table, strict=True):
        assert isinstance(log.data, Record)
        away = log.data["x"] - mass.simulate(log, initial="rest")["x"]
        size = np.linalg.norm(log.data["x"] - log.data["x"].mean())
        assert row["fit %"] == pytest.approx(100 * (1 - np.linalg.norm(away) / size), abs=0.01)
        assert row["rms"] == pytest.approx(1e3 * np.sqrt(np.mean(away**2)), rel=1e-3)
        assert row["x noise"] == pytest.approx(row["rms"], rel=1e-6)  # the noise is 1 mm
        assert (row["log"], row["use"]) == (log.source, USES[log.use])


def test_several_models_are_rows_of_one_table(mass: Model, data: Dataset, fitted: Fit) -> None:
    found = pysim.compare(mass, fitted.model, truth(mass), data)
    assert tuple(dict.fromkeys(found.table["model"])) == ("Mass", "Mass fitted", "Mass + toy.friction")
    rows = {(row["model"], row["log"]): row["x noise"] for row in found.table}
    for log in ("a.txt", "b.txt"):
        assert rows["Mass", log] > rows["Mass fitted", log] > 10 * rows["Mass + toy.friction", log]
    legend = [text.get_text() for text in found.plot().legends[0].get_texts()]
    assert len(legend) == 4
    assert all("%" in text for text in legend[1:])
    for one in (found, pysim.compare(mass, data)):
        assert max(len(repr(one)), len(one._repr_html_())) < 2000


def test_limits_are_the_users_or_those_of_the_thesis(mass: Model, data: Dataset) -> None:
    good, bad = truth(mass), mass
    own = {"fit %": 99.0, "x noise": 1.2}
    assert pysim.compare(good, data).passes is None
    assert pysim.compare(good, data, criteria=own).passes is True
    assert pysim.compare(bad, data, criteria=own).passes is False
    assert pysim.compare(good, data, criteria="thesis").passes is True
    for wrong in ("strict", {"rmse": 1.0}):
        with pytest.raises(BadInput, match="criteria"):
            _ = pysim.compare(good, data, criteria=wrong).table


def test_where_it_is_worst_comes_first(mass: Model, data: Dataset) -> None:
    where = pysim.compare(mass, data).where()
    errors = where.table["residual over noise"]
    assert list(errors) == sorted(errors, reverse=True)
    assert errors[0] > 50
    assert len(where.plot().axes[0].patches) == 12


def test_a_log_of_no_use_for_a_fit_is_compared_all_the_same(mass: Model, data: Dataset) -> None:
    only = replace(data, records=tuple(replace(one, use="test") for one in data.records))
    assert pysim.compare(truth(mass), only).table["use"] == ("held out", "held out")


def test_a_displaced_start_is_estimated_from_the_log_itself(mass: Model) -> None:
    """An undamped mass of 1 kg on 16 N/m, let go 0.1 m away: 0.1 cos 4 t."""
    times = np.arange(0, 4, 0.01)
    read = 0.1 * np.cos(4 * times) + 1e-3 * np.random.default_rng(1).standard_normal(times.size)
    log = Record(times, np.column_stack([0 * times, read]), ("F", "x"), ("N", "m"))
    signals = (MeasuredSignal("F", "input", "N", "", "F"), MeasuredSignal("x", "output", "m", "", "x", noise=1e-3))
    held = Dataset("let go", "", "", signals, (MeasuredRecord("a.txt", "other", "test", log),))
    free = mass.set(d=0.0, k=16.0)
    assert pysim.compare(free, held, initial="estimate").table["x noise"][0] == pytest.approx(1.0, abs=0.1)
    assert pysim.compare(free, held, initial={"x": 0.1}).table["x noise"][0] == pytest.approx(1.0, abs=0.1)
    assert pysim.compare(free, held, initial="rest").table["x noise"][0] == pytest.approx(71, abs=2)  # 0.1/sqrt(2) m


def test_what_is_no_model_or_no_data_is_refused(mass: Model, data: Dataset) -> None:
    for given, said in (((data,), "one model"), (("Toy.Mass", data), "one model"), ((mass, 3), "no measurements")):
        with pytest.raises(BadInput, match=said):
            pysim.compare(*given)


def test_comparison_diagnosis_and_fit_say_the_same(mass: Model, data: Dataset, why: Diagnosis) -> None:
    """One number for one question, as near as integration errors are held."""
    rel = 0.5 * Settings().fine ** 2  # what an error of that share of the noise adds to its root mean square
    by_compare = pysim.compare(why.model, data).table["x noise"]
    assert by_compare == pytest.approx([why.steps["fitted"][-1], why.steps["used to choose"][-1]], rel=rel)


def test_a_log_that_is_held_out_is_not_said_to_be_missing(mass: Model) -> None:
    """Nothing looks at it before the verdict, which is no reason to say that every log is fitted."""
    said, data = "every record is fitted", measured(3, "toy.friction", F_c=0.0)
    for use, lacks in (("test", False), ("fit", True)):
        records = tuple(one if one.use == "fit" else replace(one, use=use) for one in data.records)
        why = pysim.diagnose(mass, replace(data, records=records), effects=["toy.friction"], max_effects=0)
        assert any(said in str(note.values.get("text", "")) for note in why.found.notes) is lacks


def test_noise_that_is_not_specified_is_one_number(mass: Model, data: Dataset) -> None:
    """It is read off the logs alone, so that a poor model counts as poor in a fit as in a comparison."""
    bare = replace(data, signals=tuple(replace(one, noise=None) for one in data.signals))
    found = pysim.fit(mass, bare)
    beside = pysim.compare(found.model, mass, bare)
    sizes = {record.noise for records in (found.found.records, *beside.records.values()) for record in records}
    (size,) = {one for (one,) in sizes}
    assert size == pytest.approx(1e-3, rel=0.06)  # of the sensor; 240 ordinates in the lowest band and more
    told = [note.values["value"] for note in (*found.found.notes, *beside.notes) if "value" in note.values]
    assert told
    assert set(told) == {size}
    assert found.signals["x noise"] == pytest.approx(beside.table["x noise"][:2], rel=1e-3)
    why = pysim.diagnose(found, effects=["toy.friction", "toy.bias"])
    assert why.steps["fitted"][1] == pytest.approx(found.signals["x noise"][0], rel=0.1)  # the least of its models'
    assert why.steps["fitted"][-1] == pytest.approx(1.0, abs=0.06)


def test_logs_in_which_nothing_moves_are_refused_for_that(mass: Model) -> None:
    """No noise at all can also be seen on a smooth log, whose cure is another."""
    still = {"t": np.arange(100) / 100, "F [N]": np.ones(100), "x [m]": np.zeros(100)}
    for use in (pysim.compare, pysim.fit):
        with pytest.raises(BadInput, match="log a test that excites it"):
            use(mass, pysim.load(still, inputs="F", outputs="x", time="t"))
    known = pysim.compare(mass, pysim.load(still, inputs="F", outputs="x", time="t", noise={"x": 1e-4}))
    assert np.isfinite(known.table["rms"]).all()
