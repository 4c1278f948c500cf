import pickle
import zipfile
from pathlib import Path

import numpy as np
import pytest

from pysim.cosim import MemberFailed, System, cosimulate
from pysim.cosim.members import Fmu
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.types import BadInput, Experiment, Model, Outcome, Port, Signal
from tests.broken import with_broken_library
from tests.cosim_parts import Linear
from tests.foreign import made_foreign
from tests.pysim.cosim.members.driving import Driven, driven
from tests.pysim.simulate.text_models import DISCARDS, LAG, text_model

STAIRS = """model Stairs "Climbs one stair every 0.25 s, and one when the input says so"
  parameter Real last = 1e9;
  input Boolean jump(start=false);
  discrete output Real stair(start=0, fixed=true);
  output Real way(start=0, fixed=true);
equation
  der(way) = stair;
  when {sample(0.25, 0.25), jump} then
    stair = pre(stair) + 1;
  end when;
  when stair >= last then
    terminate("up there");
  end when;
end Stairs;
"""
SAMPLES = """model Samples "No state; takes its input every T, and counts"
  parameter Real T = 1e-3;
  input Real u(start=0);
  discrete output Real held(start=0, fixed=true);
  discrete output Real count(start=0, fixed=true);
equation
  when sample(0, T) then
    held = u;
    count = pre(count) + 1;
  end when;
end Samples;
"""
H, T, K = 0.1, 0.5, 2.0
KINDS = [(fmi, interface) for fmi in (2, 3) for interface in ("co-simulation", "model-exchange")]
FINE = Rodas(rtol=1e-9, atol=1e-9)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("members")


def lagged(inputs: np.ndarray, y: float = 0.3) -> np.ndarray:
    """T y' + y = K u at the ends of steps of H with u held."""
    rows = []
    for u in inputs:
        y = K * u + (y - K * u) * np.exp(-H / T)
        rows.append(y)
    return np.array(rows)


@pytest.mark.parametrize(("fmi", "interface"), KINDS)
def test_held_inputs_give_the_exact_outputs(folder: Path, fmi: int, interface: str) -> None:
    u = np.random.default_rng(3).normal(size=30)
    member = Fmu("lag", text_model(LAG, folder, fmi=fmi), interface=interface, solver=FINE)
    for _ in range(2):  # a closed member begins as if it had never run
        with driven(member) as run:
            assert (run["y"], run["power"]) == (0.3, 0.0)
            np.testing.assert_allclose(run.rows("y", u), lagged(u), atol=2e-5)
            assert run["power"] == pytest.approx(K * u[-1] * run["y"], abs=1e-12)


@pytest.mark.parametrize(("fmi", "interface"), KINDS)
def test_saved_states_repeat_bit_for_bit(folder: Path, fmi: int, interface: str) -> None:
    u = np.sin(np.arange(20.0))
    with driven(Fmu("lag", text_model(LAG, folder, fmi=fmi), interface=interface)) as run:
        assert run.member.can_rollback
        run.rows("y", u)
        kept, time = run.member.save(), run.time
        first = run.rows("y", u)
        for _ in range(2):
            run.member.restore(kept)
            run.time = time
            assert run.rows("y", u) == first
        kept = run.member.save(kept)
        run.member.restore(kept)


@pytest.mark.parametrize(("fmi", "interface"), KINDS)
def test_an_fmu_of_another_tool(folder: Path, tmp_path: Path, fmi: int, interface: str) -> None:
    text_model(LAG, folder, fmi=fmi)
    model = read_model(made_foreign(folder / f"Lag_{fmi}.fmu", tmp_path / "foreign.fmu"))
    member = Fmu("lag", model, interface=interface)
    assert dict(member.feedthrough) == {name: frozenset({"u"}) for name in ("y", "power")}
    assert not Fmu("lag", model, interface=interface, feedthrough="declared").feedthrough
    assert member.can_rollback == (interface == "model-exchange")
    with driven(member) as run:
        np.testing.assert_allclose(run.rows("y", np.ones(5)), lagged(np.ones(5)), atol=1e-5)


@pytest.mark.parametrize(("fmi", "interface"), KINDS)
def test_outputs_follow_inputs_at_once_where_they_say_so(folder: Path, fmi: int, interface: str) -> None:
    member = Fmu("lag", text_model(LAG, folder, fmi=fmi), interface=interface)
    assert member.feedthrough == {"power": frozenset({"u"})}
    assert not Fmu("lag", member.model, feedthrough="none").feedthrough
    with driven(member) as run:
        run.go(u=1.0)
        run.give(u=3.0)
        member.update()
        assert run["power"] == pytest.approx(K * 3.0 * run["y"], abs=1e-12)


@pytest.mark.parametrize(("fmi", "interface"), KINDS)
def test_parameters_start_values_inputs_and_what_is_recorded(folder: Path, fmi: int, interface: str) -> None:
    model = text_model(LAG, folder, fmi=fmi)
    member = Fmu("lag", model, parameters={"K": 3.0, "y_start": 1.0, "u": 1.0}, record=("T", "y"), interface=interface)
    assert [(p.name, p.unit, p.start) for p in member.inputs] == [("u", "1", 1.0)]
    assert [(p.name, p.unit) for p in member.outputs] == [("y", "1"), ("power", "1"), ("T", "s")]
    with driven(member, T=0.25, K=5.0) as run:
        assert (run["y"], run["T"]) == (1.0, 0.25)
        run.go()
        assert run["y"] == pytest.approx(5.0 - 4.0 * np.exp(-H / 0.25), abs=1e-4)


@pytest.mark.parametrize("interface", ["co-simulation", "model-exchange"])
def test_an_event_of_fmi_3_is_handled_in_step_or_with_the_others(folder: Path, interface: str) -> None:
    member = Fmu("stairs", text_model(STAIRS, folder, fmi=3), interface=interface)
    early = interface == "co-simulation"
    assert member.may_return_early == early
    with driven(member) as run:
        assert [run.go(), run.go()] == [0.1, 0.2]
        assert not member.event
        reached = run.go()
        assert reached == pytest.approx(0.25 if early else 0.3, abs=1e-12)
        if early:
            assert member.event
            assert run["stair"] == 0.0
            member.update()
            assert not member.event
            run.time = member.step(run.time, 0.30000000000000004)
        assert run["stair"] == 1.0
        assert run["way"] == pytest.approx(0.05, abs=1e-6)


def test_an_event_within_rounding_of_a_point_is_at_the_point(folder: Path) -> None:
    """110*1e-4 is 0.011000000000000001, and 11*1e-3 is 0.011: nobody is asked for the step between them."""
    sizes = []

    class Watching(Linear):
        def step(self, time: float, end: float) -> float:
            sizes.append(end - time)
            return super().step(time, end)

    watching = Watching("w", (), (Port("y"),), A=[[0.0]], B=np.zeros((1, 0)), C=[[1.0]])
    member = Fmu("c", text_model(SAMPLES, folder, fmi=3), parameters={"u": 0.0})
    record = cosimulate(System((watching, member)), Experiment(np.arange(301) * 1e-4, ("c.count",)), step=1e-4)
    assert record["c.count"].tolist() == [tick // 10 + 1 for tick in range(301)]
    assert min(sizes) > 0.99e-4


@pytest.mark.parametrize(("step", "every"), [(0.01, 1), (1 / 30, 3), (1e-4, 10)])
@pytest.mark.parametrize(("fmi", "interface"), [kind for kind in KINDS if kind != (2, "co-simulation")])
def test_a_sampled_fmu_takes_the_inputs_of_its_sample(
    folder: Path, fmi: int, interface: str, step: float, every: int
) -> None:
    member = Fmu("c", text_model(SAMPLES, folder, fmi=fmi), interface=interface, parameters={"T": every * step})
    times, ticks = step * np.arange(301), np.arange(301)
    experiment = Experiment(times, ("c.held", "c.count"), {"c.u": Signal.lines([0, 100], [0, 100])})
    record = cosimulate(System((member,)), experiment, step=step)
    assert record["c.count"].tolist() == (ticks // every + 1).tolist()
    np.testing.assert_allclose(record["c.held"], times[ticks // every * every], atol=1e-12)
    assert record.statistics["events"] == 300 // every


@pytest.mark.parametrize(("step", "every"), [(0.01, 1), (1 / 30, 3), (1e-4, 10)])
@pytest.mark.parametrize("fmi", [2, 3])
def test_without_events_its_sample_is_half_a_step_late(folder: Path, fmi: int, step: float, every: int) -> None:
    """The standard gives no way to tell of the event: the FMU handles it with the signal's mean over the step."""
    model = text_model(SAMPLES, folder, fmi=fmi)
    member = Fmu("c", model, interface="co-simulation", parameters={"T": every * step}, events=False)
    times, ticks = step * np.arange(301), np.arange(301)
    experiment = Experiment(times, ("c.held", "c.count"), {"c.u": Signal.lines([0, 100], [0, 100])})
    record = cosimulate(System((member,)), experiment, step=step)
    assert record["c.count"].tolist() == (ticks // every + 1).tolist()
    np.testing.assert_allclose(record["c.held"], step * np.maximum(ticks // every * every - 0.5, 0), atol=1e-12)


def test_an_event_that_is_due_is_kept_with_the_state(folder: Path) -> None:
    with driven(Fmu("c", text_model(SAMPLES, folder), interface="model-exchange"), T=0.2) as run:
        run.go(u=1.0)
        assert not run.member.event
        run.go()
        assert run.member.event
        kept = run.member.save()
        for _ in range(2):
            run.give(u=3.0)
            run.member.update()
            assert (run["held"], run["count"], run.member.event) == (3.0, 2.0, False)
            run.member.restore(kept)
            assert run.member.event
        run.go(u=5.0)  # nobody has asked for an update: the step begins with it
        assert (run["held"], run["count"], run.member.event) == (5.0, 2.0, False)


@pytest.mark.parametrize("fmi", [2, 3])
def test_the_smallest_step_is_made_without_states_too(folder: Path, fmi: int) -> None:
    with driven(Fmu("c", text_model(SAMPLES, folder, fmi=fmi), events=False), step=1e-4) as run:
        run.go()
        after = float(np.nextafter(run.time, 1.0))
        assert run.member.step(run.time, after) == after


@pytest.mark.parametrize("fmi", [2, 3])
def test_events_left_to_the_fmu_end_no_step_early(folder: Path, fmi: int) -> None:
    member = Fmu("stairs", text_model(STAIRS, folder, fmi=fmi), events=False)
    assert not member.may_return_early
    with driven(member) as run:
        assert [run.go() for _ in range(6)] == pytest.approx([0.1, 0.2, 0.3, 0.4, 0.5, 0.6], abs=1e-12)
        assert run["stair"] == 2.0
        assert run["way"] == pytest.approx(0.25 + 2 * 0.1, abs=1e-6)


@pytest.mark.parametrize(("fmi", "interface"), KINDS)
def test_an_input_that_is_no_continuous_number_acts_at_an_event(folder: Path, fmi: int, interface: str) -> None:
    member = Fmu("stairs", text_model(STAIRS, folder, fmi=fmi), interface=interface)
    assert not member.takes_rates
    with driven(member) as run:
        run.go(jump=0.0)
        run.go(jump=1.0)
        assert run["stair"] == 1.0
        assert run["way"] == pytest.approx(0.1, abs=1e-6)


@pytest.mark.parametrize(("fmi", "interface"), KINDS)
def test_a_member_that_ends_the_run_says_so(folder: Path, fmi: int, interface: str) -> None:
    member = Fmu("stairs", text_model(STAIRS, folder, fmi=fmi), interface=interface, events=False)
    with driven(member, step=0.25, last=2.0) as run:
        run.go()
        with pytest.raises(MemberFailed) as caught:
            _go_twice(run)
        assert caught.value.outcome is Outcome.TERMINATED
        assert run.time <= 0.5


def _go_twice(run: Driven) -> None:
    """An event at the very end of a step belongs to that step, or to the next one."""
    run.go()
    run.go()


@pytest.mark.parametrize(("fmi", "interface"), KINDS)
def test_a_step_that_cannot_be_done_is_told_in_the_fmus_words(folder: Path, fmi: int, interface: str) -> None:
    with driven(Fmu("root", text_model(DISCARDS, folder, fmi=fmi), interface=interface)) as run:
        run.go(u=1.0)
        with pytest.raises(MemberFailed, match=r"sqrt|finite|discard") as caught:
            run.go(u=-2.0)
        assert caught.value.outcome is not Outcome.TERMINATED


def test_what_is_wrong_with_the_settings(folder: Path) -> None:
    model = text_model(LAG, folder)
    with pytest.raises(BadInput, match=r"Lag_2\.fmu has no variable 'Q'"):
        Fmu("lag", model, parameters={"Q": 1.0})
    with pytest.raises(BadInput, match="cannot be set to nan"):
        Fmu("lag", model, parameters={"K": float("nan")})
    with pytest.raises(BadInput, match="has no variable 'z'"):
        Fmu("lag", model, record=("z",))
    with pytest.raises(BadInput, match=r"lag: record is the text 'y'; write a tuple of names, \('y',\)"):
        Fmu("lag", model, record="y")
    with pytest.raises(BadInput, match="interface 'CS' is not known; write one of co-simulation, model-exchange"):
        Fmu("lag", model, interface="CS")
    with pytest.raises(BadInput, match="feedthrough 'all' is not known; write one of standard, declared, none"):
        Fmu("lag", model, feedthrough="all")
    with pytest.raises(BadInput, match=r"read_model makes of an \.fmu file"):
        Fmu("lag", "Lag.fmu")  # type: ignore[arg-type]
    member = Fmu("lag", model)
    with pytest.raises(BadInput, match="has not been started"):
        member.step(0.0, 0.1)
    with pytest.raises(BadInput, match=r"lag\.u is an input; give it a signal"), driven(member, u=1.0):
        pass
    with pytest.raises(BadInput, match="has no variable"), driven(member, W=1.0):
        pass


def test_an_interface_that_is_not_there(folder: Path, fixture_path: Path) -> None:
    with pytest.raises(BadInput, match="does not offer co-simulation; it offers model-exchange"):
        Fmu("x", read_model(fixture_path), interface="co-simulation")
    assert Fmu("x", read_model(fixture_path)).interface == "model-exchange"


@pytest.fixture
def fixture_path(tmp_path: Path) -> Path:
    from tests.pysim.simulate.fixture_fmus import OSCILLATOR, build

    return build(OSCILLATOR, 2, tmp_path)


def test_a_member_that_has_not_started_goes_to_another_process(folder: Path) -> None:
    model: Model = text_model(LAG, folder)
    again = pickle.loads(pickle.dumps(Fmu("lag", model, parameters={"K": 3.0}, solver=FINE)))
    assert (again.name, again.parameters, again.solver) == ("lag", {"K": 3.0}, FINE)
    assert again.inputs == Fmu("l", model).inputs


INITIAL = """model Balanced "Starts in balance with its input"
  input Real u(start=0);
  output Real y;
initial equation
  y = 2*u;
equation
  der(y) = 2*u - y;
end Balanced;
"""


@pytest.mark.parametrize(("fmi", "interface"), KINDS)
def test_initial_equations_see_the_inputs_that_are_there_at_the_end_of_initialisation(
    folder: Path, fmi: int, interface: str
) -> None:
    member = Fmu("balanced", text_model(INITIAL, folder, fmi=fmi), interface=interface)
    run = Driven(member, {}, H)
    member.start(run.setup)
    run.give(u=3.0)
    member.begin()
    assert run["y"] == pytest.approx(6.0, abs=1e-12)
    run.go()
    assert run["y"] == pytest.approx(6.0, abs=1e-9)
    member.close()


@pytest.mark.parametrize(("fmi", "interface"), KINDS)
@pytest.mark.parametrize("name", ["second", "first"])
def test_an_fmu_that_can_be_there_only_once(folder: Path, tmp_path: Path, fmi: int, interface: str, name: str) -> None:
    model = text_model(LAG, folder, fmi=fmi)
    kind = "CoSimulation" if interface == "co-simulation" else "ModelExchange"
    once = tmp_path / "once.fmu"
    with zipfile.ZipFile(model.path) as old, zipfile.ZipFile(once, "w") as new:
        for item in old.infolist():
            text = old.read(item)
            if item.filename == "modelDescription.xml":
                flag = f'<{kind} canBeInstantiatedOnlyOncePerProcess="true" '.encode()
                text = text.replace(f"<{kind} ".encode(), flag)
            new.writestr(item, text)
    first, second = (Fmu(name, read_model(once), interface=interface) for name in ("first", name))
    with driven(first):
        with pytest.raises(BadInput, match=rf"{name}: once\.fmu allows one instance per process, and first is it; put"):
            second.start(Driven(second, {}, H).setup)
        second.close()
    with driven(second) as run:
        assert run["y"] == 0.3


@pytest.mark.parametrize(("fmi", "interface"), KINDS)
def test_a_library_that_cannot_be_loaded_is_the_users_to_hear_of(
    folder: Path, tmp_path: Path, fmi: int, interface: str
) -> None:
    model = read_model(with_broken_library(text_model(LAG, folder, fmi=fmi).path, tmp_path / "broken.fmu"))
    member = Fmu("lag", model, interface=interface)
    with pytest.raises(BadInput, match=r"broken\.fmu: its library Lag cannot be loaded"), driven(member):
        pass


@pytest.mark.parametrize(("fmi", "interface"), KINDS)
def test_an_update_without_news_calls_nothing_that_a_strict_fmu_refuses(folder: Path, fmi: int, interface: str) -> None:
    member = Fmu("stairs", text_model(STAIRS, folder, fmi=fmi), interface=interface, events=False)
    with driven(member) as run:
        run.go(jump=1.0)
        for _ in range(2):
            member.update()
            assert run["stair"] == 1.0
        run.give(jump=0.0)
        member.update()
        run.go()
        assert run["stair"] == 1.0
        assert run["way"] == pytest.approx(0.2, abs=1e-6)


@pytest.mark.parametrize("fmi", [2, 3])
def test_a_whole_number_is_given_one_that_it_can_be(folder: Path, fmi: int) -> None:
    text = """model Counts
  parameter Integer n = 3;
  input Boolean b(start=true);
  input Integer i(start=1);
  output Real y(start=0, fixed=true);
equation
  der(y) = if b then n + i else 0;
end Counts;
"""
    model = text_model(text, folder, fmi=fmi)
    for name, value, cure in (
        ("n", 2.5, "give a whole number"),
        ("n", 3e10, "give -2147483648 to 2147483647"),
        ("i", 0.5, "give a whole number"),
        ("i", -3e10, "give -2147483648 to 2147483647"),
        ("b", 2, "give 0 to 1"),
        ("n", "2", "give a finite number"),
        ("i", None, "give a number"),
    ):
        with pytest.raises(BadInput, match=rf"{name} .*cannot be set to .*{cure}"):
            Fmu("counts", model, parameters={name: value})
    with pytest.raises(BadInput, match=r"n is .* and cannot be set to 3"):
        simulate(model, Experiment([0, 1], ("y",), overrides={"n": 3e10}), solver=Rodas())
    record = simulate(model, Experiment([0, 1], ("y",), overrides={"n": 2, "b": True}), solver=Rodas())
    assert record["y"][-1] == pytest.approx(3)


def test_an_input_is_given_a_finite_number(folder: Path) -> None:
    with pytest.raises(BadInput, match="u cannot be set to inf; give a finite number"):
        Fmu("lag", text_model(LAG, folder), parameters={"u": float("inf")})
