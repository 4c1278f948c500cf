"""A fit: its numbers, and when it warns."""

import json
from dataclasses import replace
from html import unescape
from pathlib import Path

import numpy as np
import pytest

import pysim
from pysim.identify.greybox import Parameter, Simulation, Treatment, problem
from pysim.nouns.fit import Fit
from pysim.nouns.model import Model
from pysim.types import BadInput, Dataset, MeasuredRecord, MeasuredSignal, ProgressEvent, Record
from pysim.workflow.fitting import fitted
from tests.pysim.nouns.conftest import TRUE
from tests.toy import measured


def test_a_fit_without_what_is_missing_warns(fitted: Fit) -> None:
    assert not fitted.ok
    assert any("poor" in text for text in fitted.warnings)
    assert set(fitted.values) == {"m", "d", "k"}
    low, high = fitted.intervals["d"]
    assert not low < TRUE["d"] < high  # biased, as the warning says


def test_a_fit_of_the_right_model_is_trusted(mass: Model) -> None:
    complete = measured(3, "toy.friction", F_c=0.0)
    found = pysim.fit(mass, complete)
    assert found.ok, found.warnings
    for name, true in TRUE.items():
        one = found.found[name]
        assert abs(one.value - true) < 4 * one.std
        assert found.table.row(name)["value"] == one.value
    assert found.correlation.row("m")["m"] == pytest.approx(1.0)
    assert np.sqrt(np.mean(found.residuals["a.txt"]["x"] ** 2)) == pytest.approx(1.0, abs=0.1)
    assert max(len(repr(found)), len(found._repr_html_())) < 2000
    assert found.model.free_names == mass.free_names
    assert found.model.values == pytest.approx(found.values)


def test_what_is_known_beforehand_counts_as_one_more_measurement(mass: Model) -> None:
    """The mean of two normal errors, each weighted by its own precision, in the fit as in the diagnosis."""
    data = measured(3, "toy.friction", F_c=0.0)
    alone = pysim.fit(mass, data).found["m"]
    mean = alone.value + 2 * alone.std
    known = mass.free("d", "k", prior={"m": (mean, alone.std)})
    found = pysim.fit(known, data)
    assert known.free_names == ("d", "k", "m")
    assert found.values["m"] == pytest.approx(alone.value + alone.std, abs=0.2 * alone.std)
    assert found.found["m"].std == pytest.approx(alone.std / np.sqrt(2), rel=0.05)
    low, high = found.profile("m").interval
    assert (high - low) / 2 / 1.96 == pytest.approx(alone.std / np.sqrt(2), rel=0.1)
    same = pysim.diagnose(known, data, effects=["toy.bias"]).found
    assert next(e.value for e in same.estimates if e.name == "m") == pytest.approx(found.values["m"], rel=1e-5)
    with pytest.raises(BadInput, match="standard deviation above 0"):
        pysim.fit(mass.free(prior={"m": (1.0, 0.0)}), data)


def test_errors_of_the_integration_do_not_pass_for_missing_physics(mass: Model) -> None:
    """A step across a sharp friction is wrong by as much as the noise at the tolerance that a fit begins with."""
    complete = measured(1, "toy.friction", F_c=0.4)
    found = pysim.fit(mass.free("m", "d", "k").with_effects("toy.friction").set(k=20.5), complete)
    assert found.ok, found.warnings
    for name, true in {**TRUE, "force.F_c": 0.4}.items():
        assert abs(found.values[name] - true) < 4 * found.found[name].std, name
    assert found.signals["x noise"] == pytest.approx([1.0, 1.0], abs=0.06)
    assert found.found.tolerance < 1e-5
    assert found.profile("k").interval == pytest.approx(found.intervals["k"], abs=found.found["k"].std)


def test_a_parameter_at_its_bound_is_said(mass: Model) -> None:
    found = pysim.fit(mass.set(m=0.8).free("d", "k", m=(0.5, 0.9)), measured(3, "toy.friction", F_c=0.0))
    assert found.table.row("m")["remark"] == "AT BOUND"
    assert any("m stopped at its bound" in text for text in found.warnings)
    assert "AT BOUND" in repr(found)


def let_go() -> Dataset:
    """1 kg on 16 N/m with 0.4 N.s/m, let go 0.05 m away: a decay of 0.2/s around a swing of sqrt(15.96) rad/s."""
    rng, times = np.random.default_rng(2), np.arange(0, 6, 0.01)
    omega = np.sqrt(16 - 0.04)
    records = []
    for source, use, away in (("a.txt", "fit", 0.05), ("b.txt", "validate", -0.08)):
        clean = away * np.exp(-0.2 * times) * (np.cos(omega * times) + 0.2 / omega * np.sin(omega * times))
        push = np.where(np.arange(times.size) >= 300, 0.5, 0.0)  # from 3 s on
        late = np.maximum(times - times[300], 0)
        step = 0.5 / 16 * (1 - np.exp(-0.2 * late) * (np.cos(omega * late) + 0.2 / omega * np.sin(omega * late)))
        read = clean + step + 2e-4 * rng.standard_normal(times.size)
        log = Record(times, np.column_stack([push, read]), ("F", "x"), ("N", "m"))
        records.append(MeasuredRecord(source, "step", use, log))
    signals = (MeasuredSignal("F", "input", "N", "", "F"), MeasuredSignal("x", "output", "m", "", "x", noise=2e-4))
    return Dataset("let go", "", "", signals, tuple(records))


def test_a_mass_that_is_let_go_is_fitted_and_its_held_out_log_too(mass: Model) -> None:
    data = let_go()
    free = mass.set(m=1.0).free("d", "k")
    found = pysim.fit(free, data, initial="estimate")
    for name, true in (("d", 0.4), ("k", 16.0)):
        assert abs(found.values[name] - true) < 5 * found.found[name].std
    for log, away in (("a.txt", 0.05), ("b.txt", -0.08)):
        for name, true in ((f"x@{log}", away), (f"v@{log}", 0.0)):
            low, high = found.intervals[name]
            assert low < true < high, name
            assert found.table.row(name)["start"] == 0.0
    assert found.table.row("x@a.txt")["s.d."] < 2e-4 / 4  # of a single sample; 600 know it better
    assert "x@a.txt" in repr(found)
    held = [row for row in found.signals if row["use"] == "used to choose"]
    assert held[0]["fit %"] > 95
    assert not any("rest" in text for text in found.warnings)
    at_rest = pysim.fit(free, data, initial="rest")
    assert any("a.txt" in text and 'initial = "estimate"' in text for text in at_rest.warnings)


def test_a_beginning_is_known_as_well_as_if_it_were_a_parameter(mass: Model) -> None:
    """The states are eliminated from the fit; as two more parameters of the log they have the same doubt."""
    data = let_go()
    found = pysim.fit(mass.set(m=1.0).free("d", "k"), data, initial="estimate").found
    states = [Parameter(name, 0.0, -1.0, 1.0, record="a.txt") for name in ("x", "v")]
    explicit = problem(mass.compiled, [data], ["d", "k", *states], treatment=Treatment(rest=None), fixed={"m": 1.0})
    best = fitted(explicit)
    x = explicit.space.to_search(np.array([best.values[key] for key in explicit.space.keys]))
    residuals = explicit.residuals(simulation=Simulation().as_fine_as(best.tolerance))
    jacobian = residuals.evaluate(explicit.model, explicit.space, x).jacobian
    white = np.sqrt(np.diag(np.linalg.inv(jacobian.T @ jacobian))) * explicit.space.slope(x)
    for name, std in zip(("x@a.txt", "v@a.txt"), white[2:], strict=True):
        assert abs(found[name].value - best[name].value) < 0.1 * std
        assert found[name].std == pytest.approx(std, rel=0.15)  # 24 blocks know a standard deviation to 1/sqrt(46)


def test_what_stands_still_or_is_not_free_is_refused(mass: Model, data: Dataset) -> None:
    with pytest.raises(BadInput, match=r"model\.free\('m'"):
        pysim.fit(mass.fix("m", "d", "k"), data)
    with pytest.raises(BadInput, match="initial"):
        pysim.fit(mass, data, initial="resting")
    with pytest.raises(BadInput, match=r"fit: a str is no model; give what pysim.model\(...\) returns"):
        pysim.fit("Toy.Mass", data)  # type: ignore[arg-type]
    with pytest.raises(BadInput, match=r"fit: .* is a file; name a folder"):
        pysim.fit(mass, data, folder=__file__)


def test_it_draws_and_is_reported(fitted: Fit, tmp_path: Path) -> None:
    worst, other = sorted(fitted.found.records, key=lambda one: -one.rms["x"])
    assert worst.use == "fit"  # so that what is drawn is not the log that was held out
    for log, drawn in (("", worst), (other.source, other)):
        assert fitted.plot(log=log).axes[0].get_title(loc="left").startswith(drawn.source)
        layout = fitted.plot(log=log, interactive=True).layout
        assert layout.title.text.startswith(drawn.source)
    assert len(fitted.plot().axes) == 2
    assert fitted.plot("parameters").axes
    assert fitted.plot("correlation").axes
    with pytest.raises(BadInput, match="not known"):
        fitted.plot("bode")
    files = fitted.report(tmp_path / "fit")
    assert "When not to trust it" in files["report"].read_text(encoding="utf-8")
    assert "poor" in fitted.summary()


def test_an_output_that_is_left_out_is_left_out_of_all_that_follows(mass: Model, data: Dataset, fitted: Fit) -> None:
    """A sensor of the speed that is dead; without it the fit is what it is without its column."""
    (signal,) = (one for one in data.signals if one.name == "x")
    records = tuple(
        replace(one, data=replace(one.data, names=(*one.data.names, "v"), units=(*one.data.units, "m/s"),
                                  values=np.column_stack([one.data.values, np.zeros(one.data.time.size)])))
        for one in data.logs() if isinstance(one.data, Record)
    )  # fmt: skip
    dead = replace(signal, name="v", unit="m/s", quantity="v", variable="v", noise=None)
    both = replace(data, signals=(*data.signals, dead), records=records)
    found, alone = pysim.fit(mass, both, outputs=["x"]), fitted
    assert found.values == alone.values
    assert found.dataset.signals == data.signals
    log = records[0]
    assert found.model.simulate(log).record["x"] == pytest.approx(alone.model.simulate(data.records[0]).record["x"])
    with pytest.raises(BadInput, match="measures no output 'y'"):
        pysim.fit(mass, both, outputs=["y"])


def test_the_lines_of_a_report_make_it_again(mass: Model, data: Dataset, tmp_path: Path) -> None:
    first = pysim.fit(mass, data, initial="rest", outputs="x")
    page = first.report(tmp_path / "first")["report"].read_text(encoding="utf-8")
    lines = unescape(page.rpartition("<pre>")[2].partition("</pre>")[0]).replace("first", "again")
    own = {"pysim": pysim, "model": mass, "data": data}
    exec(lines, own)
    assert own["fitted"].values == first.values
    assert (tmp_path / "again" / "report.html").is_file()


def test_a_report_replaces_no_file_of_the_user(fitted: Fit, tmp_path: Path) -> None:
    mine = tmp_path / "other"
    mine.mkdir()
    for name in ("parameters.toml", "notes.txt"):
        (mine / name).write_text("mine")
    with pytest.raises(BadInput, match=r"parameters.toml is there already"):
        fitted.report(mine)
    assert {path.name: path.read_text() for path in mine.iterdir()} == {"parameters.toml": "mine", "notes.txt": "mine"}


def test_a_fit_that_was_saved_is_the_same_again(mass: Model, tmp_path: Path) -> None:
    wanted = mass.set(k=20.5).free("d", "k", m=(0.6, 4)).with_effects("toy.friction")
    for name, found in (
        ("added", pysim.fit(wanted, measured(1, "toy.friction", F_c=0.4), outputs=["x"])),
        ("let go", pysim.fit(mass.set(m=1.0).free("d", "k"), let_go(), initial="estimate")),
    ):
        found.save(tmp_path / name)
        again = Fit.load(tmp_path / name)
        assert (again.model.name, again.model.free_names) == (found.model.name, found.model.free_names)
        assert dict(again.begun.bounds) == dict(found.begun.bounds)
        assert again.table["start"] == pytest.approx(found.table["start"], abs=1e-9)
        assert found.ok, found.warnings
        for one in (*found.found.estimates, *found.found.initial):
            assert again.found[one.name].value == pytest.approx(one.value, abs=1e-3 * one.std)
            assert again.found[one.name].std == pytest.approx(one.std, rel=0.01)
        assert again.signals["x noise"] == pytest.approx(found.signals["x noise"], rel=1e-3)
        assert again.warnings == found.warnings
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "model.fmu").write_text("mine")
    for there in ("added", "mine"):
        before = {path: path.read_bytes() for path in (tmp_path / there).rglob("*") if path.is_file()}
        with pytest.raises(BadInput, match="holds files already"):
            found.save(tmp_path / there)
        assert before == {path: path.read_bytes() for path in (tmp_path / there).rglob("*") if path.is_file()}
    with pytest.raises(BadInput, match=r"fit\.save"):
        Fit.load(tmp_path)


def test_a_saved_fit_that_is_damaged_is_to_be_made_again(fitted: Fit, tmp_path: Path) -> None:
    file = fitted.save(tmp_path / "kept")
    whole = file.read_text(encoding="utf-8")
    said = json.loads(whole)
    texts = ["", whole[:100], whole[:-2], "[]", "3", "[" * 100_000]
    for key in said:
        less = {name: one for name, one in said.items() if name != key}
        wrong = [[[]], {"m": "much"}, "tolerance" if key == "tolerance" else 3]
        texts += map(json.dumps, [less, *({**said, key: one} for one in wrong)])
    texts.append(json.dumps({**said, "found": {name: one for name, one in said["found"].items() if name != "m"}}))
    for text in texts:
        file.write_text(text, encoding="utf-8")
        with pytest.raises(BadInput) as refused:
            Fit.load(file.parent)
        assert str(file) in str(refused.value)
        assert "fit again" in refused.value.cure
    file.write_text(whole, encoding="utf-8")
    assert Fit.load(file.parent).values == pytest.approx(fitted.values)


def test_progress_goes_to_who_asked_for_it(mass: Model, caplog: pytest.LogCaptureFixture) -> None:
    heard: list[str] = []
    complete = measured(3, "toy.friction", F_c=0.0)
    with caplog.at_level("INFO", logger="pysim"):
        pysim.fit(mass.free("d"), complete, progress=lambda event: heard.append(event.stage))
    assert heard
    assert "point 0" in heard[0]
    assert caplog.records
    assert {one.name for one in caplog.records} == {"pysim"}

    def stop(event: object) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        pysim.fit(mass.free("d"), complete, progress=stop)


def test_a_fit_that_was_interrupted_goes_on_from_its_folder(mass: Model, tmp_path: Path) -> None:
    complete = measured(3, "toy.friction", F_c=0.0)
    whole, first, rest = list[str](), list[str](), list[str]()

    def interrupt(event: ProgressEvent) -> None:
        first.append(event.stage)
        if len(first) == 4:
            raise KeyboardInterrupt

    uninterrupted = pysim.fit(mass, complete, progress=lambda event: whole.append(event.stage))
    with pytest.raises(KeyboardInterrupt):
        pysim.fit(mass, complete, folder=tmp_path, progress=interrupt)
    found = pysim.fit(mass, complete, folder=tmp_path, progress=lambda event: rest.append(event.stage))
    assert len(rest) < len(whole)
    assert found.values == pytest.approx(uninterrupted.values, rel=1e-9)


def test_the_run_of_a_log_is_the_curve_that_the_fit_shows(mass: Model) -> None:
    """Fitted or held out; from the model's own start it would be off by all of the 0.05 and 0.08 m at the beginning."""
    data = let_go()
    found = pysim.fit(mass.set(m=1.0).free("d", "k"), data, initial="estimate")
    for log, shown, away in zip(data.logs(), found.found.records, (0.05, -0.08), strict=True):
        run = found.model.simulate(log)
        assert run["x"] == pytest.approx(shown.simulated["x"], abs=2e-5)  # a tenth of the noise
        assert run["x"][0] == pytest.approx(away, abs=2e-4)
        assert found.model.simulate(log, initial={})["x"][0] == 0.0
        assert found.model.simulate(log, initial={"x": 0.02})["x"][0] == pytest.approx(0.02)
        assert found.model.simulate(log, dt=0.1, record=["v"])["v"].shape == (61,)


def test_a_fitted_model_begins_as_its_fit_did_and_so_does_what_it_is_compared_with(mass: Model) -> None:
    """The mass was let go 0.05 and 0.08 m away, over the square root of two some 200 and 300 times the noise."""
    data, true = let_go(), mass.set(m=1.0, d=0.4, k=16.0)
    found = pysim.fit(mass.set(m=1.0).free("d", "k"), data, initial="rest")
    assert pysim.compare(found.model, data).table["rms"] == pytest.approx(found.signals["rms"], rel=1e-3)
    assert min(pysim.compare(true, found.model, data).table["x noise"]) > 50
    assert max(pysim.compare(true, data).table["x noise"]) < 1.1
    assert max(pysim.compare(true, found.model, data, initial="estimate").table["x noise"][:2]) < 1.1
    assert pysim.fit(found.model, data).values == pytest.approx(found.values, rel=1e-2)


def test_the_run_of_a_log_that_no_fit_has_seen_begins_as_compare_begins_it(mass: Model) -> None:
    data, plant = let_go(), mass.set(m=1.0, d=0.4, k=16.0)
    for initial in ("estimate", "rest", None):
        shown, _ = plant.beside(data, initial)
        for log, one in zip(data.logs(), shown, strict=True):
            assert plant.simulate(log, initial=initial)["x"] == pytest.approx(one.simulated["x"], abs=2e-5)
    log = data.records[0]
    assert isinstance(log.data, Record)
    alone = replace(log, data=Record(log.data.time, log.data.values[:, :1], ("F",), ("N",)))
    assert plant.simulate(alone)["x"][0] == 0.0  # nothing says where it began
    assert plant.simulate(log, F=0.0)["x"][0] == 0.0
    assert plant.set(x=0.01).simulate(log)["x"][0] == 0.01


def test_a_state_that_is_set_is_where_fit_comparison_and_the_run_of_a_log_begin(mass: Model) -> None:
    """The mass of the first log was let go there. A word for the first sample wins."""
    data, plant = let_go(), mass.set(m=1.0, d=0.4, k=16.0, x=0.05)
    assert pysim.compare(plant, data).table["x noise"][0] == pytest.approx(1.0, abs=0.1)
    for initial in (None, "rest", "estimate"):
        shown, _ = plant.beside(data, initial)
        run = plant.simulate(data.logs()[1], initial=initial)
        assert run["x"] == pytest.approx(shown[1].simulated["x"], abs=2e-5)
        assert run["x"][0] == pytest.approx({None: 0.05, "rest": 0.0, "estimate": -0.08}[initial], abs=0.005)
    for initial in (None, "rest"):
        found = pysim.fit(plant.free("d", "k"), data, initial=initial)
        run = found.model.simulate(data.logs()[0])
        assert run["x"] == pytest.approx(found.found.records[0].simulated["x"], abs=2e-5)
        assert found.model.set(x=0.01).simulate(data.logs()[0])["x"][0] == 0.01
