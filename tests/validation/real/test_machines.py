"""Base models of real machines: what an effect does, and how logs are read; the logs are made up."""

from pathlib import Path

import numpy as np
import pytest

from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, Model, Signal
from pysim.types.record_kind import Command
from validation.held_out import held_out_rms
from validation.initial_states.mass import TRUTH, force, logged, mass_model, measured, motion
from validation.real.case import KNOWN, run
from validation.real.machines import MACHINES, Machine, measured_folder

TIME = np.linspace(0.0, 5.0, 101)
every_machine = pytest.mark.parametrize("machine", MACHINES.values(), ids=lambda machine: machine.name)


def driven(model: Model, **overrides: float) -> np.ndarray:
    """The output of a model under eight units of a sine, which is large beside every limit; a pendulum from 1 rad."""
    (command,) = (v.name for v in model.variables if v.causality == "input")
    (output,) = (v.name for v in model.variables if v.causality == "output")
    offset = [1.0 if name == "theta" else 0.0 for name in model.abilities.states]
    signal = Signal.through(TIME, 8 * np.sin(2 * np.pi * 0.4 * TIME))
    run = Experiment(TIME, (output,), {command: signal}, overrides, offset=np.array(offset))
    return simulate(model, run, solver=Rodas(1e-7, 1e-7))[output]


@every_machine
def test_effects_that_are_off_change_nothing_and_each_that_is_on_does(machine: Machine) -> None:
    chosen = [effect for effect in machine.subject.catalogue if not effect.bypass]
    model, places = machine.subject.variants.build(chosen)
    base = driven(machine.subject.model)
    size = np.ptp(base)
    np.testing.assert_allclose(driven(model), base, atol=1e-6 * size)
    for effect in chosen:
        nominal = {f"{places[effect.name]}.{p.name}": p.nominal for p in effect.parameters}
        change = driven(model, **nominal) - base
        assert np.abs(change).max() > 1e-5 * size, effect.name


@every_machine
def test_effects_that_are_bypassed_tend_to_nothing_as_they_shrink(machine: Machine) -> None:
    base = driven(machine.subject.model)
    for effect in machine.subject.catalogue:
        if effect.bypass:
            model, places = machine.subject.variants.build([effect])
            (parameter,) = effect.parameters
            name = f"{places[effect.name]}.{parameter.name}"
            off, on = (driven(model, **{name: value}) for value in (0.0, parameter.nominal))
            assert np.abs(off - base).max() < 0.3 * np.abs(on - base).max(), effect.name


@every_machine
def test_logs_are_read_by_our_description_and_those_held_out_are_withheld(machine: Machine, tmp_path: Path) -> None:
    for file in described(machine):
        path = tmp_path / f"real-{machine.name}" / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("0 0 1\n1 1 2\n2 1 4\n3 0 3\n", encoding="utf-8")
    dataset = machine.measurements(tmp_path)
    assert {record.source for record in dataset.records} == set(described(machine))
    assert {record.use for record in dataset.records} == {"fit", "test"}
    assert dataset.records[-1].initial == "estimate"
    (held,) = (signal.hold for signal in dataset.signals if signal.role == "input")
    assert held is (None if machine.name == "hydraulic-actuator" else Command.STEPS)


def described(machine: Machine) -> list[str]:
    import tomllib

    text = (machine.folder / "dataset.toml").read_text(encoding="utf-8")
    return [row["file"] for row in tomllib.loads(text)["records"]]


def test_where_the_logs_are_not_every_claim_is_skipped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("REAL_MEASUREMENTS", raising=False)
    assert measured_folder() is None
    assert measured_folder(tmp_path) is None
    found = list(run(tmp_path))
    assert len(found) == len(KNOWN)
    assert all(finding.skipped and not finding.holds for finding in found)


def test_of_a_true_model_noise_is_left_of_a_log_that_begins_in_motion() -> None:
    rng, time = np.random.default_rng(5), np.arange(1001) / 100
    records = []
    for use, start in (("fit", (0.0, 0.0)), ("test", (0.08, -0.4)), ("test", (-0.05, 0.9))):
        pushed = force(time, seed=3)
        states = motion(time, pushed, start) + 1e-3 * rng.standard_normal((time.size, 2))
        records.append(logged(f"{use} {start}", time, pushed, states, ("x",), use))
    data = measured("mass", tuple(records), {"x": 1e-3})
    assert held_out_rms(mass_model(), data, TRUTH)["x"] == pytest.approx(1e-3, rel=0.07)
    assert held_out_rms(mass_model(), data, {**TRUTH, "c": 1.2 * TRUTH["c"]})["x"] > 5e-3
