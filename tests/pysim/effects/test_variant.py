"""A model's class with effects in its slots: text, places of parameters, and what is refused. Building it is tested in
tests/modelica/test_effects.py."""

from itertools import combinations
from pathlib import Path

import pytest

from fmu_build import build
from pysim.effects import fitting, read_catalogue, variant, variant_text
from pysim.io import read_model
from pysim.types import BadInput
from tests import toy
from tests.modelica.library import LIBRARY
from tests.pysim.effects.test_catalogue import library

EFFECTS = {effect.name: effect for effect in read_catalogue(LIBRARY)}
FREE, LOCKED = (f"HydraulicTestBench.Pump.{name}GreyBox" for name in ("Free", "Locked"))
CONTROL = "HydraulicTestBench.Pump.SwashPlateControl"
RIG = "HydraulicTestBench.LoadCircuit.OpenTestBench"


def squeezed(text: str) -> str:
    return " ".join(text.split())


def test_one_effect_of_a_base_that_inherits_its_slots() -> None:
    made = variant(LOCKED, [EFFECTS["oil.air"]], [LIBRARY], name="Airy")
    assert squeezed(made.text) == (
        'model Airy "LockedGreyBox with oil.air" '
        f"extends {CONTROL}( data=HydraulicTestBench.Data.LockedGreyBox(), "
        "redeclare HydraulicTestBench.Effects.OilAir oil); end Airy;"
    )
    assert made.parameter("oil.air", "eps") == "oil.eps"
    assert variant_text(LOCKED, [EFFECTS["oil.air"]], [LIBRARY]).startswith("model PumpVariant")


def test_no_effect_is_the_base_itself() -> None:
    assert squeezed(variant(FREE, [], [LIBRARY]).text) == (
        f'model PumpVariant "FreeGreyBox with no effect" extends {FREE}; end PumpVariant;'
    )


def test_effects_that_share_a_slot_go_into_pairs() -> None:
    names = ("friction.coulomb", "valve.offset", "spring.preload", "swash.bias")
    made = variant(CONTROL, [EFFECTS[name] for name in names], [LIBRARY])
    assert made.places == {
        "friction.coulomb": "pistonForce.first.first",
        "spring.preload": "pistonForce.first.second",
        "swash.bias": "pistonForce.second",
        "valve.offset": "spoolOpening",
    }
    assert made.text.count("extends HydraulicTestBench.Effects.Pairs.PistonForces(") == 2
    assert "redeclare PistonForce2 pistonForce" in made.text
    assert made.text.count(f"extends {CONTROL}(") == 1


def test_a_pair_that_is_one_class_holds_both_effects_parameters() -> None:
    made = variant(FREE, [EFFECTS["valve.saturation"], EFFECTS["valve.rate_limit"]], [LIBRARY])
    assert "redeclare HydraulicTestBench.Effects.Pairs.SpoolLimits spool" in made.text
    assert made.places == {"valve.saturation": "spool", "valve.rate_limit": "spool"}


def test_every_two_effects_of_the_catalogue_can_be_written() -> None:
    for base, count in ((FREE, 18), (RIG, 6)):
        taken = fitting(list(EFFECTS.values()), base, [LIBRARY])
        assert len(taken) >= count
        for a, b in combinations(taken, 2):
            assert set(variant(base, [a, b], [LIBRARY]).places) == {a.name, b.name}


OWN = """
package Own
  model Wide
    extends HydraulicTestBench.Pump.SwashPlateControl(data=HydraulicTestBench.Data.FreeGreyBox(), K_p=Numbers.gain);
    Real more = 1;
  end Wide;
  model Tuned extends HydraulicTestBench.Pump.SwashPlateControl(K_p=Numbers.gain, final b=2*Numbers.gain); end Tuned;
  package Numbers constant Real gain = 42; end Numbers;
  model Twice "Both"
    extends HydraulicTestBench.Interfaces.PartialCompressibility;
    parameter Real eta(unit="1", min=0, max=1) = 0;
  equation
    kappa1 = eta; kappa2 = eta;
    annotation(__HydraulicTestBench(effect="own.oil", slot="oil"));
  end Twice;
end Own;
"""


def test_a_users_base_keeps_its_modifications_under_their_full_names(tmp_path: Path) -> None:
    made = variant("Own.Tuned", [EFFECTS["oil.air"]], [LIBRARY, library(tmp_path, OWN)])
    assert "K_p=Own.Numbers.gain,\n    final b=2*Own.Numbers.gain,\n    redeclare" in made.text


def test_refuses(tmp_path: Path) -> None:
    places = [LIBRARY, library(tmp_path, OWN)]
    own = next(effect for effect in read_catalogue(*places) if effect.name == "own.oil")
    air = EFFECTS["oil.air"]
    for base, effects, message in (
        ("Own.Nothing", [air], "no class Own.Nothing"),
        ("Own.Wide", [air], "Own.Wide declares more"),
        ("HydraulicTestBench.Hydraulics.Chamber", [air], "has no replaceable part oil"),
        (FREE, [air, air], "named twice"),
        (FREE, [air, own], 'share the slot oil.*pair="oil"'),
    ):
        with pytest.raises(BadInput, match=message):
            variant(base, effects, places)


def test_the_fmu_of_a_class_with_values_starts_from_them(tmp_path: Path) -> None:
    (effect,) = (e for e in read_catalogue(toy.library()) if e.name == "toy.friction")
    mine = tmp_path / "Mine.mo"
    mine.write_text('model Mine "A heavier mass"\n  extends Toy.Mass(m=3, d=0.5);\nend Mine;\n')
    values = {"m": 4.0, "k": 12.5, "force.F_c": 0.3}
    made = variant("Mine", [effect], [toy.library(), mine], name="MineFitted", values=values, comment="Said\n\nabove.")
    assert made.text.startswith("// Said\n//\n// above.\nmodel MineFitted")
    (tmp_path / "MineFitted.mo").write_text(made.text)
    model = read_model(build("MineFitted", tmp_path / "a.fmu", libraries=[toy.library(), tmp_path / "MineFitted.mo"]))
    assert {name: model[name].start for name in (*values, "d")} == {**values, "d": 0.5}
    assert (model["m"].max, model["force.F_c"].max) == (5, 5)  # bounds stay
