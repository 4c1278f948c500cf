"""A model: what it holds, what is said of it, and how it runs."""

import math
import random
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas
import pytest

import pysim
from pysim.identify.greybox.time_log import kept_columns
from pysim.io import read_model
from pysim.nouns.model import Model
from pysim.types import BadInput, Dataset, MeasuredRecord, Record, SimulationError
from tests.toy import library, measured


def test_its_tables_say_what_it_holds(mass: Model) -> None:
    assert (mass.inputs["name"], mass.outputs["name"], mass.states["name"]) == (("F",), ("x", "v"), ("x", "v"))
    assert mass.parameters.row("m") == {
        "name": "m", "value": 1.0, "min": 0.5, "max": 5.0, "unit": "kg", "description": "", "free": True,
    }  # fmt: skip
    assert mass.slots.row("force")["sees"] == "x, v"
    assert "toy.friction" in mass.effects["name"]
    assert mass.free_names == ("m", "d", "k")


def test_what_is_said_of_it_makes_another_model(mass: Model) -> None:
    one = mass.set(m=2.0)
    assert (mass.values, one.values, one.free_names) == ({}, {"m": 2.0}, ("d", "k"))
    some = mass.free("d", m=(0.8, 1.2))
    assert (some.free_names, dict(some.bounds)) == (("d", "m"), {"m": (0.8, 1.2)})
    assert some.set(m=1.1).free_names == ("d", "m")  # where it begins
    assert some.fix("m").free_names == ("d",)
    assert mass.fix(k=19.0).values == {"k": 19.0}
    assert mass.fix("m").free("m", "k").free_names == ("m", "k")


@pytest.mark.parametrize(
    ("ask", "said"),
    [
        (lambda m: m.set(mm=1.0), "no variable 'mm'; near it: m"),
        (lambda m: m.free("F"), "F is no parameter .* it has m, d, k"),
        (lambda m: m.free(m=("a", "b")), "m: 'a' is no number"),
        (lambda m: m.free(prior={"m": 3}), r"write m=\(mean, standard deviation\)"),
        (lambda m: m.set(m=0.49), "m = 0.49 is outside its bounds, 0.5 to 5.0 kg"),
        (lambda m: m.fix(m=5.1), "m = 5.1 is outside its bounds"),
        (lambda m: m.free(m=(1, 2)).set(m=0.7), "outside its bounds, 1.0 to 2.0 kg"),
        (lambda m: m.with_effects(3), "effects: a int is none"),
        (lambda m: m.simulate("run1"), r"write simulate\(2.0\), or simulate\(data"),
        (lambda m: m.simulate(measured(1)), "neither a time in s nor one log"),
        (lambda m: m.simulate(1, dt="fast"), "dt: 'fast' is no number"),
        (lambda m: m.simulate(measured(1).records[0], initial={"x": "much"}), "initial: 'much' is no number"),
        (lambda m: m.export(3), "folder: 3 is no path"),
        (lambda m: pysim.model(m), "name: a Model is no path"),
        (lambda m: m.free(m=(2, 1)), r"m=\(lowest, highest\)"),
        (lambda m: m.with_effects("toy.frction"), "did you mean toy.friction"),
        (lambda m: m.with_effects("toy.bias", "toy.bias"), "once"),
        (lambda m: m.slot("spool"), "its slots: force"),
        (lambda m: m.simulate(-1), "above zero"),
        (lambda m: m.simulate(1, F="much"), "input F"),
        (lambda m: m.simulate(1, G=1.0), "no variable 'G'"),
        (lambda m: pysim.model("Toy.Mass"), "Toy"),
        (lambda m: pysim.model("Toy.Mass", library="nowhere"), "nowhere is not there"),
        (lambda m: pysim.model("none.mo"), "no such file"),
    ],
)
def test_mistakes_are_refused_with_a_cure(mass: Model, ask, said: str) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(BadInput, match=said):
        ask(mass)


@pytest.mark.parametrize(
    ("ask", "argument", "cure"),
    [
        (lambda m, data: pysim.model("Toy.Mass", library="nowhere"), "library", "name the folder"),
        (lambda m, data: m.free(m=(2, 1)), "m", "write m=(lowest, highest)"),
        (lambda m, data: m.simulate(1, F="much"), "F", ""),
        (lambda m, data: pysim.fit(m, 3), "data", "give what pysim.load"),
        (lambda m, data: pysim.fit(m, data, initial="resting"), "initial", ""),
        (lambda m, data: pysim.fit(m, data, starts="two"), "starts", ""),
        (lambda m, data: pysim.fit(m, data, starts=1.5), "starts", "write one"),
        (lambda m, data: m.simulate(1, initial="rest"), "initial", "write state = value"),
        (lambda m, data: pysim.load({"t": [0, 1, 2], "x": [0, 1, 2]}, outputs="x"), "inputs", ""),
        (lambda m, data: pysim.load({"t": [0, 1], "x": [0, 1]}, inputs=3, outputs="x"), "inputs", ""),
        (
            lambda m, data: pysim.load({"t": [0, 1], "x": [0, 1]}, inputs="x", outputs="x", noise={"x": "a"}),
            "noise",
            "",
        ),
    ],
)
def test_a_mistake_names_the_argument_and_the_cure(mass, data, ask, argument, cure) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(BadInput) as refused:
        ask(mass, data)
    assert refused.value.argument == argument
    assert refused.value.cure.startswith(cure)


def test_one_name_or_a_list_of_names_will_do(mass: Model, data: Dataset) -> None:
    assert mass.free(["m", "k"]).free_names == ("m", "k") == mass.free("m").free(("k",)).free_names
    assert mass.fix(["m", "k"]).free_names == ("d",)
    assert mass.with_effects(["toy.friction"]).effects_in == mass.with_effects("toy.friction").effects_in
    assert mass.simulate(1, record="x").record.names == ("x",)
    session = pysim.open_session(mass.compiled, data, library=library(), free="m", effects="toy.friction")
    assert [one.name for one in (*session.parameters, *session.catalogue)] == ["m", "toy.friction"]


def test_bounds_that_are_given_are_those_that_a_value_stays_in(mass: Model) -> None:
    wider = mass.free(m=(0.05, 9)).set(m=0.1)
    assert wider.free_names == ("m",)
    assert wider.fix("m").values == {"m": 0.1}


def test_where_the_last_free_one_is_fixed_nothing_is_free(mass: Model) -> None:
    assert mass.free("m").fix("m").free_names == ()
    assert mass.free("m").fix("m").free("k").free_names == ("k",)


def test_values_of_numpy_become_plain_numbers(mass: Model) -> None:
    assert type(mass.set(m=np.float32(2.0)).values["m"]) is float


def test_a_column_over_time_stamps_counts_in_seconds(mass: Model) -> None:
    values = [0.0, 1.0, 0.0]
    plain = mass.simulate(2.0, F=pandas.Series(values, index=[0.0, 1.0, 2.0])).record["x"]
    for index in (pandas.to_timedelta([0, 1, 2], "s"), pandas.date_range("2026-01-01", periods=3, freq="s")):
        assert mass.simulate(2.0, F=pandas.Series(values, index=index)).record["x"] == pytest.approx(plain)


def test_nothing_to_free_is_refused(mass: Model) -> None:
    with pytest.raises(BadInput, match=r"model\.free\('m', 'd', 'k'\)"):
        mass.free()


@pytest.mark.parametrize(("low", "high"), [(1.5, 3.0), (6.0, 8.0)])
def test_bounds_beside_the_value_are_refused_with_a_line_that_mends_it(mass: Model, low: float, high: float) -> None:
    """m is 1 kg between 0.5 and 5."""
    with pytest.raises(BadInput, match="m = 1 is outside") as refused:
        mass.free(m=(low, high))
    mended = eval(str(refused.value).split("too: ")[1], {"model": mass})
    assert mended.bounds["m"] == (low, high)
    assert low < mended.values["m"] < high
    friction = mass.with_effects("toy.friction")  # off, and fitted from its usual size of 0.3 N
    assert friction.free(**{"force.F_c": (0.1, 2.0)}).bounds["force.F_c"] == (0.1, 2.0)


def test_the_start_of_a_state_may_be_free_and_is_shown(mass: Model) -> None:
    assert mass.free("x").table.row("x")["value"] == 0.0
    assert "x" in repr(mass.free("x"))


def swing(t: np.ndarray, force: float = 3.0) -> np.ndarray:
    """An undamped mass of 1 kg on 16 N/m under a step of the force at 0.5 s: it swings at 4 rad/s."""
    return np.where(t < 0.5, 0.0, force / 16 * (1 - np.cos(4 * (t - 0.5))))


@pytest.mark.parametrize(
    "push",
    [
        [(0, 0), (0.5, 3)],
        np.array([[0.0, 0.0], [0.5, 3.0]]),
        [(0.5, 3.0)],
    ],
)
def test_an_input_may_be_pairs(mass: Model, push: object) -> None:
    run = mass.set(d=0.0, k=16.0).simulate(2, dt=0.01, F=push if len(push) > 1 else [(0, 0), *push])  # type: ignore[arg-type]
    assert run.time == pytest.approx(np.linspace(0, 2, 201))
    assert run["x"] == pytest.approx(swing(run.time), abs=1e-3)


def test_an_input_may_be_a_number_a_row_or_a_function(mass: Model) -> None:
    """m x'' + 16 x = t is solved by (t - sin(4 t)/4)/16 from rest."""
    free = mass.set(d=0.0, k=16.0)
    expected = (np.linspace(0, 2, 501) - np.sin(4 * np.linspace(0, 2, 501)) / 4) / 16
    for push in (lambda t: t, [0.0, 1.0, 2.0], np.linspace(0, 2, 5)):
        assert free.simulate(2, F=push)["x"] == pytest.approx(expected, abs=1e-4)
    still = free.simulate(2, F=0.0)["x"]
    assert np.all(still == 0.0)


def test_a_run_without_a_log_begins_at_the_states_that_are_given(mass: Model) -> None:
    """Without a force the mass swings from there: against the same states, set."""
    begun, set_ = mass.simulate(1.0, initial={"x": 0.1}), mass.set(x=0.1).simulate(1.0)
    assert begun["x"][0] == 0.1
    assert np.array_equal(begun["x"], set_["x"])


def test_an_fmu_without_its_class_may_be_given_no_effect(mass: Model) -> None:
    alone = pysim.model(mass.compiled.path)
    assert alone.with_effects() is alone
    with pytest.raises(BadInput, match="its class"):
        alone.with_effects("toy.friction")


@pytest.mark.parametrize("more", [{}, {"F": 1.0}])
def test_a_word_for_the_first_sample_that_is_not_known_is_refused_of_any_log(
    mass: Model, data: Dataset, more: dict[str, float]
) -> None:
    (log, *_) = data.logs()
    assert isinstance(log.data, Record)
    alone = replace(log, data=kept_columns(log.data, ("F",)))
    for one in (log, alone):
        with pytest.raises(BadInput) as refused:
            mass.simulate(one, initial="rset", **more)
        assert refused.value.argument == "initial"
    assert np.array_equal(mass.simulate(alone, initial="rest")["x"], mass.simulate(alone, initial={})["x"])


def test_a_log_drives_the_inputs_that_its_columns_are_named_like(mass: Model, data: Dataset) -> None:
    log = data.records[0]
    run = mass.simulate(log)
    assert isinstance(log.data, Record)
    assert run.time == pytest.approx(log.data.time)
    assert np.corrcoef(run["x"], log.data["x"])[0, 1] > 0.9
    other = Record(log.data.time, log.data.values, ("force", "x"), log.data.units)
    with pytest.raises(BadInput, match="rename the column"):
        mass.simulate(MeasuredRecord("a.txt", "other", "fit", other))


@pytest.mark.parametrize("hold", ["zero", "linear"])
@pytest.mark.parametrize("initial", ["rest", {}])
def test_a_log_of_a_data_set_drives_an_input_between_samples_as_that_says(mass, hold, initial) -> None:  # type: ignore[no-untyped-def]
    """A force that is held, or runs straight, from sample to sample, given as such, and rests at its first."""
    t, F = 0.5 * np.arange(9), np.array([0.0, 0, 1, 0, 2, 1, -1, 0, 0])
    far = np.linspace(0, 4, 81)
    table = {"t": t, "F": F, "x": np.cos(9 * t)}
    loaded = pysim.load(table, inputs="F", outputs="x", units={"F": "N", "x": "m"}, hold={"F": hold}, noise={"x": 1e-3})
    run = mass.simulate(loaded[loaded.names[0]], dt=0.05, initial=initial)
    given = list(zip(t, F, strict=True)) if hold == "zero" else pandas.Series(F, index=t)
    wanted = mass.simulate(4.0, dt=0.05, F=given)
    assert run["x"] == pytest.approx(np.interp(far, wanted.time, wanted["x"]), abs=1e-5)


def test_a_run_has_a_row_at_every_step_that_is_asked_for(mass: Model) -> None:
    assert mass.simulate(1.0, dt=0.3, F=0.0).time == pytest.approx([0, 0.3, 0.6, 0.9, 1])
    log = measured(1).records[0]
    assert isinstance(log.data, Record)
    time = mass.simulate(log, dt=0.3 * log.data.time[-1]).time
    assert time / log.data.time[-1] == pytest.approx([0, 0.3, 0.6, 0.9, 1])


@pytest.mark.parametrize("phase", [0.0, 0.5 * math.pi, 4.0])
def test_a_steady_sine_is_simulated_at_the_phase_of_its_log(mass: Model, phase: float) -> None:
    """20 s of a sine at 0.8 Hz, settled: the answer is the frequency response of the equation of motion."""
    time, w = np.arange(0, 20, 0.01), 2 * math.pi * 0.8
    response = 1 / (20.0 - w**2 + 0.8j * w)
    x = np.imag(response * np.exp(1j * (w * time + phase)))
    log = Record(time, np.column_stack([np.sin(w * time + phase), x]), ("F", "x"), ("N", "m"))
    record = MeasuredRecord("sine.csv", "frequency-response", "fit", log, offset=0.0, amplitude=1.0, frequency=0.8)
    assert mass.simulate(replace(record, command="F")).record["x"] == pytest.approx(x, abs=2e-3 * float(np.ptp(x)))


def test_a_log_in_another_unit_is_turned_into_that_of_the_input(mass: Model, data: Dataset) -> None:
    log = data.records[0]
    assert isinstance(log.data, Record)
    values = log.data.values / np.array([1e3, 1.0])
    kilo = Record(log.data.time, values, log.data.names, ("kN", "m"))
    one, other = mass.simulate(log), mass.simulate(MeasuredRecord("a.txt", log.kind, "fit", kilo))
    assert other["x"] == pytest.approx(one["x"], abs=1e-5)  # its first states are estimated, and the search rounds
    one, other = (mass.simulate(each, initial={}) for each in (log, MeasuredRecord("a.txt", log.kind, "fit", kilo)))
    assert other["x"] == pytest.approx(one["x"], abs=1e-6)  # the solver's tolerance


def test_a_run_that_fails_is_raised_or_given_back(tmp_path: Path) -> None:
    (tmp_path / "Early.mo").write_text(
        'model Early output Real x(start=0, fixed=true); equation der(x) = 1; when x > 0.5 then terminate("enough"); '
        "end when; end Early;"
    )
    early = pysim.model(tmp_path / "Early.mo")
    assert early.simulate(1, check=False).time[-1] == pytest.approx(0.5, abs=0.01)
    with pytest.raises(SimulationError, match=r"ended the run at 0\.5 s"):
        early.simulate(1)


def test_an_effect_that_was_added_is_free_and_off_until_it_is_fitted(mass: Model) -> None:
    one = mass.with_effects("toy.friction")
    assert one.free_names == ("m", "d", "k", "force.F_c")
    assert one.usual() == {"force.F_c": 0.3}
    off = one.simulate(1, F=2.0)["x"]
    assert off == pytest.approx(mass.simulate(1, F=2.0)["x"], abs=1e-6)
    assert mass.free("m").with_effects("toy.friction").free_names == ("m", "force.F_c")
    on = one.set(**{"force.F_c": 1.0}).simulate(1, F=2.0)["x"]
    assert on.max() < off.max()


def test_what_is_exported_runs_as_the_model_does(mass: Model, tmp_path: Path) -> None:
    one = mass.with_effects("toy.friction").set(m=1.4, **{"force.F_c": 0.5})
    files = one.export(tmp_path / "better")
    again = pysim.model(files["fmu"])
    assert again.simulate(1, F=2.0)["x"] == pytest.approx(one.simulate(1, F=2.0)["x"], abs=1e-5)
    assert read_model(files["fmu"])["force.F_c"].start == 0.5


def test_a_closed_fmu_says_that_nothing_can_be_added(foreign: Path) -> None:
    closed = pysim.model(foreign)
    assert (len(closed.slots), closed.variants) == (0, None)
    with pytest.raises(BadInput, match="its class is in no library"):
        closed.with_effects("toy.friction")


def test_it_prints_in_a_few_lines(mass: Model, foreign: Path) -> None:
    pump = pysim.model("HydraulicTestBench.Pump.FreeGreyBox")
    for one in (mass, pump, pysim.model(foreign)):
        assert max(len(repr(one)), len(one._repr_html_()), len(repr(one.parameters))) < 2000
    assert "F [N]" in repr(mass)
    assert "m_eff" in repr(pump)


def test_it_is_sketched_with_its_ports_and_what_is_in_its_slots(mass: Model, foreign: Path) -> None:
    shown = {text.get_text() for text in mass.with_effects("toy.friction").plot().axes[0].texts}
    assert {"F [N]", "x [m]", "v [m/s]", "force\ntoy.friction"} <= shown
    assert any("m = 1 kg" in text and "force.F_c" in text for text in shown)
    assert not any("empty" in text.get_text() for text in pysim.model(foreign).plot().axes[0].texts)


def test_a_run_prints_draws_and_is_saved(mass: Model, tmp_path: Path) -> None:
    run = mass.simulate(1, F=2.0)
    assert len(repr(run)) < 2000 > len(run._repr_html_())
    assert run.table.row("x")["at the end"] == run["x"][-1]
    assert len(run.plot().axes) == 2  # m and m/s
    for _ in range(2):  # a run that was saved there is replaced
        assert run.save(tmp_path / "run.csv").read_text().count("\n") > 500
    (tmp_path / "bench.csv").write_text("t,x\n0,1\n")
    with pytest.raises(BadInput, match=r"bench.csv is there already and holds no run; name another file"):
        run.save(tmp_path / "bench.csv")
    assert (tmp_path / "bench.csv").read_text() == "t,x\n0,1\n"
    assert math.isclose(run.time[-1], 1.0)


def test_a_run_is_not_saved_over_a_measurement(mass: Model, tmp_path: Path) -> None:
    run, log = mass.simulate(1.0), tmp_path / "run1.csv"
    log.write_text("time [s],x [mm]\n0,0\n1,2\n")
    with pytest.raises(BadInput, match="holds no run"):
        run.save(log)
    assert log.read_text().startswith("time [s],x [mm]")
    run.save(tmp_path / "own.csv")
    run.save(tmp_path / "own.csv")


def test_a_function_is_followed_however_long_the_run(mass: Model) -> None:
    """2001 even times see zeros alone in the wave, and a jump late by up to the time between two of them."""
    wave = mass.simulate(20.0, dt=0.007, record=["F"], F=lambda t: np.sin(100 * np.pi * t))
    assert wave["F"] == pytest.approx(np.sin(100 * np.pi * wave.time), abs=1e-5)
    jumping = mass.simulate(600.0, dt=0.1, F=lambda t: 1.0 if t < 1.05 else -2.0)
    pairs = mass.simulate(600.0, dt=0.1, F=[(0.0, 1.0), (1.05, -2.0)])
    assert jumping["x"] == pytest.approx(pairs["x"], abs=1e-3 * np.ptp(pairs["x"]))


def test_a_function_without_an_end_to_its_changes_is_refused(mass: Model) -> None:
    noise = random.Random(0).random
    with pytest.raises(BadInput, match=r"^input F: the function changes too fast"):
        mass.simulate(1.0, F=lambda t: noise())


@pytest.mark.parametrize("given", [None, "5", math.nan, [1.0, 2.0]])
def test_a_function_returns_numbers(mass: Model, given: object) -> None:
    array = mass.simulate(1.0, F=lambda t: np.array([t]))
    assert np.array_equal(array["x"], mass.simulate(1.0, F=lambda t: t)["x"])
    with pytest.raises(BadInput, match=r"^input F: .* no finite number; let it return one"):
        mass.simulate(1.0, F=lambda t: given)
    with pytest.raises(BadInput, match=r"^input a\.F: .* no finite number; let it return one"):
        pysim.cosimulate({"a": mass}, dt=0.1, stop=1.0, wires={}, inputs={"a.F": lambda t: given})
