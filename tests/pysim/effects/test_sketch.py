"""Sketches of laws: a curve, a family, an answer over time; right against closed forms, none where there is none."""

import math

import pytest

from pysim.effects import STANDARD_LIBRARY, Sketch, fitting, law_constants, law_sketch, read_catalogue, slots
from pysim.effects.sketch import Sizes, constants, sketch


def drawn(law: str, sees: list[str], gives: str = "y", **parameters: tuple[float, str]) -> Sketch | None:
    return sketch(law, sees, [gives], Sizes(parameters, {}, {}))


def curve(
    law: str, sees: list[str], gives: str = "y", **parameters: tuple[float, str]
) -> tuple[list[float], list[float]]:
    found = drawn(law, sees, gives, **parameters)
    assert found is not None
    assert not found.over_time
    (only,) = found.curves
    return only


def test_a_dead_zone_is_flat_in_its_middle() -> None:
    x, y = curve("y = noEvent(if s > 0 then max(s - u_0, 0) else min(s + u_0, 0));", ["s"], u_0=(0.016, "1"))
    assert (x[0], x[-1], y[0], y[-1]) == pytest.approx((-1, 1, -1, 1))
    assert all(b == 0 for a, b in zip(x, y, strict=True) if abs(a) < 0.33)
    assert all(b != 0 for a, b in zip(x, y, strict=True) if abs(a) > 0.34)


def test_dry_friction_acts_against_the_motion() -> None:
    x, y = curve("f = -F_c*tanh(v/v_t);", ["x", "v"], "f", F_c=(80.0, "N"))
    assert y == pytest.approx([-math.tanh(25 * at) for at in x], abs=1e-3)


def test_a_cubic_spring_is_odd() -> None:
    x, y = curve("f = -k_3*x^3;", ["x", "v"], "f", k_3=(2.5e7, "N/m3"))
    assert y == pytest.approx([-(at**3) for at in x])


def test_what_stands_in_equations_of_its_own_is_followed() -> None:
    law = "q = K*held;\nheld = max(p, 0);"
    x, y = curve(law, ["p", "Q"], "q", K=(3.0, "1"))
    assert y == pytest.approx([max(at, 0) for at in x])


def test_two_variables_are_a_family() -> None:
    found = drawn("f = -k*x*v;", ["x", "v"], "f", k=(2.0, "1"))
    assert found is not None
    assert found.words == "f over x, for three values of v"
    ends = [y[-1] for _, y in found.curves]
    assert ends == pytest.approx([1, 0, -1])  # v = -1, 0, 1


def test_a_lag_answers_a_wave_as_it_must() -> None:
    found = drawn("der(y) = (s - y)/T;", ["s"], T=(0.02, "s"))
    assert found is not None
    assert found.over_time
    (x, wave), (_, answer) = found.curves
    turn = 2 * math.pi / 10  # times T: the wave takes ten of them
    time = [7.5 * (at + 1) for at in x]  # over T
    late = [
        (math.sin(turn * t) - turn * math.cos(turn * t) + turn * math.exp(-t)) / (1 + turn**2) for t in time
    ]  # from rest
    assert wave == pytest.approx([math.sin(turn * t) for t in time], abs=1e-9)
    assert answer == pytest.approx(late, abs=0.03)


def test_play_takes_along_after_its_width_and_stands_where_the_wave_turns() -> None:
    law = "der(y) = (max(s - h - y, 0) + min(s + h - y, 0))/T_h;"
    found = sketch(law, ["s"], ["y"], Sizes({"h": (0.01, "1")}, {"T_h": 1e-5}, {}))
    assert found is not None
    (_, wave), (_, answer) = found.curves
    assert max(answer) == pytest.approx(2 / 3, abs=0.01)  # the wave is three times its half
    assert all(abs(a - b) <= 1 / 3 + 0.05 for a, b in zip(wave, answer, strict=True))


def test_a_sampled_output_is_a_staircase() -> None:
    law = "when sample(0, T_held) then\n  y = s;\nend when;"
    fixed = constants({"T_held": "max(T_s, T_min)", "T_min": "1e-4"}, {"T_s": 4e-3})
    assert "T_min" in fixed
    sizes = Sizes({"T_s": (4e-3, "s")}, {"T_held": 4e-3}, {}, "max(T_s, T_min)")
    found = sketch(law, ["s"], ["y"], sizes)
    assert found is not None
    levels = [y for k, y in enumerate(found.curves[1][1]) if k == 0 or y != found.curves[1][1][k - 1]]
    assert len(levels) in (15, 16)  # ten samples in each of one and a half periods


def test_a_rate_goes_along_with_its_variable() -> None:
    found = drawn("y = 0.5*z + 0.5*s;\nder(z) = s_t;", ["s", "s_t"])
    assert found is not None
    (_, wave), (_, answer) = found.curves
    assert answer == pytest.approx(wave, abs=0.05)


@pytest.mark.parametrize(
    "law",
    [
        "y = __import__('os').system('true');",
        "y = s*v*w;",
        "der(y) = s*w - y;",
        "y = 0;",
        "y = (1).real;",
        "y = s^999999999;",
        "y = 1e300*s*1e300;",
        "",
    ],
)
def test_what_cannot_be_drawn_is_not_drawn(law: str) -> None:
    assert drawn(law, ["s", "v", "w"], T=(1.0, "s")) is None


def test_every_effect_of_the_pump_has_its_sketch() -> None:
    name = "HydraulicTestBench.Pump.FreeGreyBox"
    around = {"omega_v": (150.0, "rad/s"), "zeta_v": (0.8, "1")}
    places = {slot.name: slot for slot in slots(name, [STANDARD_LIBRARY])}
    found = {
        effect.name: law_sketch(effect, places[effect.slot], law_constants(effect, [STANDARD_LIBRARY]), around)
        for effect in fitting(read_catalogue(STANDARD_LIBRARY), name, [STANDARD_LIBRARY])
    }
    assert len(found) >= 18
    assert [name for name, one in found.items() if one is None] == []
    assert {name for name, one in found.items() if one is not None and one.over_time} == {
        "card.sampling", "linkage.backlash", "sensor.lag", "supply.droop", "valve.hysteresis", "valve.rate_limit",
        "valve.saturation",
    }  # fmt: skip
