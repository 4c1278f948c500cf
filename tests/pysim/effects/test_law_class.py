"""A law as a user writes it: the class that it becomes, and what is refused, with its place."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fmu_build import build
from pysim.effects import STANDARD_LIBRARY, Slot, law_class, read_catalogue, slot_units, slots
from pysim.effects.law import read_law
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.types import BadInput, EffectParameter, Experiment, Signal
from pysim.workflow import Variants
from tests.toy import CATALOGUE, library

PLACES = [STANDARD_LIBRARY, library()]
FORCE = next(slot for slot in slots("Toy.Mass", PLACES) if slot.name == "force")
DRAG = EffectParameter("c_2", "N.s2/m2", 0.0, 10.0, 1.0, 0.0, 0.0, "Drag, 0 = off")
WIDTH = EffectParameter("w", "m/s", 1e-3, 1.0, 0.1, 0.02, None)


def made(law: str, *parameters: EffectParameter, slot: Slot = FORCE) -> str:
    return law_class("Own", slot, law, parameters or (DRAG, WIDTH), PLACES, effect="own.drag")


def test_the_catalogue_reads_back_what_was_written(tmp_path: Path) -> None:
    limit = EffectParameter("inverse_v_m", "s/m", 0.0, 50.0, 5.0, 0.0, 0.0, "", "v_m", "v")
    gain = EffectParameter("g", "1", 0.0, 2.0, 0.5, 1.5, 1.0)
    (tmp_path / "Own.mo").write_text(made("f = -g*c_2*v*abs(v)/max(1, v*inverse_v_m)", DRAG, WIDTH, limit, gain))
    (effect,) = read_catalogue(tmp_path / "Own.mo")
    assert (effect.name, effect.slot, effect.class_name) == ("own.drag", "force", "Own")
    assert effect.parameters == (DRAG, WIDTH, limit, gain)


def test_a_law_moves_the_model_as_the_class_written_by_hand_does(tmp_path: Path) -> None:
    """Toy.Rubbing, as a formula."""
    friction = EffectParameter("F_c", "N", 0.0, 5.0, 0.3, 0.0, 0.0)
    (tmp_path / "Own.mo").write_text(made("-F_c*tanh(v/0.02)", friction))
    (own,) = read_catalogue(tmp_path / "Own.mo")
    run = Experiment(np.linspace(0.0, 2.0, 201), ("x",), {"F": Signal.constant(3.0)}, {"force.F_c": 0.4})
    places = (STANDARD_LIBRARY, library(), tmp_path / "Own.mo")
    models = [Variants("Toy.Mass", places).build([one])[0] for one in (CATALOGUE["toy.friction"], own)]
    by_hand, by_law = (simulate(model, run, solver=Rodas())["x"] for model in models)
    assert np.abs(by_hand).max() > 0.05
    assert by_law == pytest.approx(by_hand, abs=1e-9)


def test_a_law_may_depend_on_time(tmp_path: Path) -> None:
    """An undamped mass of 1 kg on a spring of 1 N/m under a force of 3 t is at 3 (t - sin t)."""
    (tmp_path / "Own.mo").write_text(made("F_t*time", EffectParameter("F_t", "N/s", 0.0, 5.0, 1.0, 0.0, 0.0)))
    (own,) = read_catalogue(tmp_path / "Own.mo")
    model, places = Variants("Toy.Mass", (*PLACES, tmp_path / "Own.mo")).build([own])
    free = {"d": 0.0, "k": 1.0, f"{places['own.drag']}.F_t": 3.0}
    times = np.linspace(0.0, 2.0, 21)
    x = simulate(model, Experiment(times, ("x",), {}, free), solver=Rodas(1e-9, 1e-9))["x"]
    assert x == pytest.approx(3.0 * (times - np.sin(times)), abs=1e-6)


def test_what_the_law_gives_besides_has_its_unit(tmp_path: Path) -> None:
    text = made("f = -c_2*speed*square;\nsquare = speed;\nspeed = if x > 0 then v else 2*v")
    assert 'Real speed(unit="m/s");' in text
    (tmp_path / "Own.mo").write_text(text)
    build("Own", tmp_path / "Own.fmu", libraries=[*PLACES, tmp_path / "Own.mo"])
    assert read_model(tmp_path / "Own.fmu")["square"].unit == "m/s"


@pytest.mark.parametrize("model", ["Pump.FreeGreyBox", "LoadCircuit.OpenTestBench"])
def test_the_plain_laws_of_the_library_are_laws(model: str) -> None:
    """Each effect without a memory, a constant or a function of its own, from its equations alone."""
    found = {slot.name: slot for slot in slots(f"HydraulicTestBench.{model}", [STANDARD_LIBRARY])}
    known = {"valve.deadband", "valve.offset", "leakage.laminar", "leakage.external", "spring.hardening", "swash.bias",
             "card.error_deadzone", "servovalve.deadband", "motor.leakage"}  # fmt: skip
    plain = [one for one in read_catalogue(STANDARD_LIBRARY) if one.name in known and one.slot in found]
    assert len(plain) >= 2
    for one in plain:
        text = law_class("Own", found[one.slot], one.law, one.parameters, [STANDARD_LIBRARY])
        assert read_law(text.partition("equation")[2].partition("end Own")[0]) == read_law(one.law)


def test_units_of_a_slot_are_those_of_its_partial_class() -> None:
    assert slot_units(FORCE, PLACES) == {"x": "m", "v": "m/s", "f": "N"}
    spool = next(s for s in slots("HydraulicTestBench.Pump.FreeGreyBox", PLACES) if s.name == "spool")
    assert slot_units(spool, PLACES)["omega_v"] == "rad/s"


@pytest.mark.parametrize(
    ("law", "said"),
    [
        ("-c_2*v*abs(vv)", "column 12: vv is no name that the law may use; did you mean"),
        ("f = -c_2*v*\nabs(tide)", "line 2, column 5: tide is no name"),
        ("-c_2*v*abss(v)", "column 8: abss is no function that the law may use; did you mean abs?"),
        ("-c_2*v*tanh(v, w)", r"column 8: tanh\(\) takes 1 argument, not 2"),
        ("system(v)", "column 1: system is no function"),
        ("f = -c_2*v", "f is in N, and what stands behind it in N.s/m"),
        ("f = 0;\nq = x + v", r"line 2, column 1: 'q = x \+ v': \+ takes m and m/s together"),
        ("f = -c_2*v^2;\nf = 0", "line 2, column 1: f is given already; keep one of the two"),
        ("r = sqrt(v);\nf = -c_2*r", "column 1: 'r = sqrt.v.': .* is no unit of Modelica; .* under a root a ratio"),
        ("x = 1", "x is given already; the slot gives f"),
        ("q = v*w", "nothing gives f of the slot force"),
        ("f = q;\nq = f", "line 1, column 1: f depends on itself"),
        ("der(f) = v", "has a memory or an event"),
        ("f = pre(f)", "pre f is no name"),
        ("when v > 0 then f = 1; end when", "cannot be worked out"),
        ("2*f = v", "write name = expression"),
        ("-c_2*(v", "column 8: the end stands where a closing bracket is expected"),
        ("-c_2*tanh(v", "column 12: the end stands where a closing bracket is expected"),
        ("-c_2*v**2", r"column 8: \* stands where a value is expected; a power is written with \^"),
        ("f = -c_2*v;\nq = v * * 2", r"line 2, column 9: \* stands where a value .* written with \^"),
        ("-c_2*5v", "column 7: v stands where the end is expected"),
        ("-c_2*v +  ", "column 9: the end stands where a value is expected"),
        ("", "stands where"),
        ("(" * 5000, "nested too deeply"),
        ("f = -c_2*v*v; annotation(x = 1)", "write name = expression"),
        ("f = -c_2*v*v; end Own; model Evil end Evil;", "no part of a law"),
    ],
)
def test_mistakes_in_a_law_are_said_with_their_place(law: str, said: str) -> None:
    with pytest.raises(BadInput, match=said) as refused:
        made(law)
    assert str(refused.value).startswith("law of Own")


@pytest.mark.parametrize(
    ("parameter", "said"),
    [
        (replace(DRAG, unit=""), 'c_2 has no unit; write "1" for a plain number'),
        (replace(DRAG, unit="N/(m.s0.5)"), r"c_2: N/\(m.s0.5\) is no unit of Modelica"),
        (replace(DRAG, unit="furlong"), "c_2: furlong is no SI unit"),
        (replace(DRAG, name="v"), "v is named twice, or is a variable of the slot force"),
        (replace(DRAG, name="w"), "w is named twice"),
        (replace(DRAG, name="c 2"), "'c 2' is no name in Modelica"),
        (replace(DRAG, name="end"), "'end' is no name in Modelica"),
    ],
)
def test_parameters_without_name_or_unit_are_refused(parameter: EffectParameter, said: str) -> None:
    with pytest.raises(BadInput, match=said):
        made("f = 0", parameter, WIDTH)
