"""Redeclarations the compiler would drop are refused at their own line; those it follows change the model."""

from pathlib import Path

import pytest

from fmu_build.errors import BuildError
from fmu_build.front import load

LIBRARY = """
package L
  partial model Slot input Real x; output Real f; end Slot;
  model Nothing extends Slot; equation f = 0; end Nothing;
  model Spring extends Slot; parameter Real k = 2; equation f = -k*x; end Spring;
  model Cart
    replaceable Nothing slot constrainedby Slot;
    replaceable model Part = Nothing constrainedby Slot;
    Part part;
    Real x(start = 1, fixed = true);
  equation
    slot.x = x; part.x = x; der(x) = slot.f + part.f;
  end Cart;
  model Heavy extends Cart; end Heavy;
  model 'Heavy one' extends Cart; end 'Heavy one';
  model Other extends Cart; replaceable Nothing second(x = slot.x) "not slot"; end Other;
  model Train Heavy cart; end Train;
  model Yard replaceable Cart cart; end Yard;
  model Sprung extends Cart(redeclare Spring slot(k = 4)); end Sprung;
  model Bad extends Heavy(
    redeclare Spring slot); end Bad;
  model Choices
    replaceable Nothing slot constrainedby Slot annotation(choices(choice(redeclare Spring slot "as a spring")));
    Real x(start = 1, fixed = true);
  equation
    slot.x = x; der(x) = slot.f;
  end Choices;
  package Carts model C extends Heavy; end C; end Carts;
  package More extends Carts; end More;
  %s
end L;
"""
OWN_LINE = LIBRARY[: LIBRARY.index("%s")].count("\n") + 1
THROUGH_BASE = "extend L.Cart instead"
NESTED = "inside a part of another part"
ELEMENT = "write it in the extends clause"


def stiffnesses(model: str, folder: Path) -> dict[str, float]:
    """Springs of the compiled model L.M."""
    file = folder / "L.mo"
    file.write_text(LIBRARY % model, encoding="utf-8")
    flat = load("L.M", [file])
    return {v.name: v.binding.value for v in flat.variables if v.name.split(".")[-1] == "k"}


@pytest.mark.parametrize(
    ("model", "expected"),
    [
        ("model M extends Cart(redeclare Spring slot); end M;", {"slot.k": 2}),
        ("model M extends Cart(redeclare Spring slot(k = 5)); end M;", {"slot.k": 5}),
        ('model M extends Cart(redeclare /* \' */ L.Spring slot "a \\"redeclare"); end M;', {"slot.k": 2}),
        ("model M public extends Cart(redeclare Spring slot); end M;", {"slot.k": 2}),
        ("model M import Q = L; extends Q.Cart(redeclare Q.Spring slot); end M;", {"slot.k": 2}),
        ("model M extends Heavy(redeclare model Part = Spring); end M;", {"part.k": 2}),
        ("model M Heavy a(redeclare model Part = Spring); end M;", {"a.part.k": 2}),
        ("model M extends Cart; redeclare model Part = Spring; end M;", {"part.k": 2}),
        ("model M extends Heavy; redeclare model Part = Spring(k = 6); end M;", {"part.k": 6}),
        ("model M Heavy a(redeclare Spring slot); end M;", {"a.slot.k": 2}),
        ("model M Real y = a.x; protected Heavy a(redeclare Spring slot); end M;", {"a.slot.k": 2}),
        ("model M parameter Boolean on = true; Heavy a(redeclare Spring slot) if on; end M;", {"a.slot.k": 2}),
        ("model N = Cart(redeclare Spring slot); model M N n; end M;", {"n.slot.k": 2}),
        ("model M extends Yard(redeclare Sprung cart); end M;", {"cart.slot.k": 4}),
        ("model M extends Choices(redeclare Spring slot); end M;", {"slot.k": 2}),
        ("model M extends Choices; end M;", {}),
    ],
)
def test_followed(model: str, expected: dict[str, float], tmp_path: Path) -> None:
    assert stiffnesses(model, tmp_path) == expected


@pytest.mark.parametrize(
    ("model", "message"),
    [
        ("model M extends Heavy(redeclare Spring slot); end M;", THROUGH_BASE),
        ("model M extends Heavy(slot(x(start = 3)), redeclare Spring slot); end M;", THROUGH_BASE),
        ("model M public extends Heavy(redeclare Spring slot); end M;", THROUGH_BASE),
        ("model M protected Real y = 1; public extends Heavy(redeclare Spring slot); end M;", THROUGH_BASE),
        ("model M equation if y > 1 then y = q; end if; public extends Heavy(redeclare Spring slot); end M;",
         THROUGH_BASE),
        ("encapsulated model M extends .L.Heavy(redeclare L.Spring slot); end M;", THROUGH_BASE),
        ("model M import Q = L; extends Q.Heavy(redeclare Spring slot); end M;", THROUGH_BASE),
        ("model M import L.Carts.*; extends C(redeclare Spring slot); end M;", THROUGH_BASE),
        ("model M import L.Carts.{C}; extends C(redeclare Spring slot); end M;", THROUGH_BASE),
        ("model M extends More.C(redeclare Spring slot); end M;", THROUGH_BASE),
        ("model M extends 'Heavy one'(redeclare Spring slot); end M;", THROUGH_BASE),
        ("model M extends Other(redeclare Spring slot); end M;", THROUGH_BASE),
        ("model N = Heavy(redeclare Spring slot); model M extends N; end M;", THROUGH_BASE),
        ("model N extends Heavy(redeclare Spring slot); end N; model M N n; end M;", THROUGH_BASE),
        ("model M model N extends Heavy(redeclare Spring slot); end N; N n; end M;", THROUGH_BASE),
        ("model M extends Train(cart(redeclare Spring slot)); end M;", NESTED),
        ("model M Train a(cart(redeclare Spring slot)); end M;", NESTED),
        ("model M Train a(cart(redeclare model Part = Spring)); end M;", NESTED),
        ("model M extends Yard(redeclare Cart cart(redeclare Spring slot)); end M;", NESTED),
        ("model M replaceable Cart a constrainedby Cart(redeclare Spring slot); end M;", "behind constrainedby"),
        ("model M extends Cart; redeclare Spring slot; end M;", ELEMENT),
        ("model M extends Cart; redeclare replaceable Spring slot; end M;", ELEMENT),
        ("model M extends Cart; redeclare model extends Part end Part; end M;", ELEMENT),
        ("model M extends Cart(redeclare Spring brake); end M;", "no replaceable part brake"),
        ("model M extends Cart(redeclare model Brake = Spring); end M;", "no replaceable part Brake"),
        ("model M extends Unknown(redeclare Spring slot); end M;", "Unknown is not found"),
    ],
)  # fmt: skip
def test_refused(model: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(BuildError, match=message) as caught:
        stiffnesses(model, tmp_path)
    assert (caught.value.file, caught.value.line) == (tmp_path / "L.mo", OWN_LINE)


def test_the_line_is_that_of_the_redeclaration_wherever_it_is_used(tmp_path: Path) -> None:
    with pytest.raises(BuildError, match=THROUGH_BASE) as caught:
        stiffnesses("model M extends Yard(redeclare Bad cart); end M;", tmp_path)
    assert LIBRARY.splitlines()[caught.value.line - 1].strip() == "redeclare Spring slot); end Bad;"


@pytest.mark.parametrize(
    "model",
    [
        "model M extends Spring(k(max = 9) = 3); end M;",
        "model M extends Spring(x(start = 1), k(min = 0, max = max(3, 9)) = 3); end M;",
        "model M extends Sprung(slot(k(max = 9) = 3)); end M;",
        "model M Sprung s(slot(k(max = 9) = 3)); end M;",
    ],
)
def test_a_value_behind_attributes_is_refused_where_it_would_be_lost(model: str, tmp_path: Path) -> None:
    with pytest.raises(BuildError, match=rf"L\.mo:{OWN_LINE}.*loses both attributes and value of k"):
        stiffnesses(model, tmp_path)


@pytest.mark.parametrize(
    "model",
    [
        "model M Spring s(k(max = 9) = 3, x = 0); end M;",
        "model Wide extends Spring(k(max = 9)); end Wide; model M extends Wide(k = 3, x = 0); end M;",
    ],
)
def test_a_value_behind_attributes_stands_where_it_is_kept(model: str, tmp_path: Path) -> None:
    assert list(stiffnesses(model, tmp_path).values()) == [3]


@pytest.mark.parametrize(
    "model",
    [
        "model M Sprung s(slot.k = 3); end M;",
        "model M Sprung s(x.start = max(3, 4)); end M;",
        "model M Sprung s(final slot.k(max = 9) = 3); end M;",
        "model M Train t(cart(x.start = 3)); end M;",
        "model M Train t(cart.x(start = 3), cart(x(fixed = true))); end M;",
        "model M extends Sprung(slot.k = 3); end M;",
        "model N = Sprung(slot.k = 3); model M N n; end M;",
    ],
)
def test_a_name_with_dots_is_refused_in_a_modification(model: str, tmp_path: Path) -> None:
    with pytest.raises(BuildError, match=rf"L\.mo:{OWN_LINE}: the compiler would lose"):
        stiffnesses(model, tmp_path)


def test_names_with_dots_may_stand_in_the_values_of_a_modification(tmp_path: Path) -> None:
    model = "model M Sprung a; Sprung b(slot(k = if a.slot.k == 4 then max(a.slot.k, 5) else 6)); end M;"
    file = tmp_path / "L.mo"
    file.write_text(LIBRARY % model, encoding="utf-8")
    assert [v.name for v in load("L.M", [file]).variables if v.name.endswith("k")] == ["a.slot.k", "b.slot.k"]


SLOTS = """
  model K extends Slot; parameter Real k = 1; parameter Real o = 2; equation f = k*o*x; end K;
  partial model Bare extends Slot; parameter Real k = 1; end Bare;
  model Bent extends Bare; equation f = -k*x; end Bent;
  model ByPart replaceable Bent s constrainedby Bare(k = 3); equation s.x = 1; end ByPart;
  model Open replaceable Bare s constrainedby Bare(k = 3); equation s.x = 1; end Open;
  model Twice replaceable Bent s(final k = 3) constrainedby Bare(k = 3); equation s.x = 1; end Twice;
  model Alone replaceable Bent s(k = 3); equation s.x = 1; end Alone;
  model Dropped replaceable Bent s(k = 3) constrainedby Bare; equation s.x = 1; end Dropped;
  model ByClass replaceable model T = Bent constrainedby Bare(k = 3); T s; equation s.x = 1; end ByClass;
  model Short replaceable model T = Bent(k = 3); T s; equation s.x = 1; end Short;
  model Long replaceable model T extends Bent(k = 3); end T; T s; equation s.x = 1; end Long;
  type Length = Real(unit = "m", start = 7);
  model Valued replaceable parameter Real y = 1; replaceable Real v = 1; end Valued;
  model Free replaceable model T = Bent(k = 3) constrainedby Slot; T s; equation s.x = 1; end Free;
""".replace("\n", " ")


@pytest.mark.parametrize(
    ("model", "message"),
    [
        ("model M Heavy a(redeclare model Part = Spring(k = 6)); end M;", "lose the modification of Spring here"),
        ("model M extends Cart(redeclare model Part = Spring(k = 6)); end M;", "redeclare model Part = Spring"),
        ("model M ByPart a; end M;", "lose k = 3 behind constrainedby; write it before"),
        ("model M ByClass a; end M;", "lose k = 3 behind constrainedby; write it at each part of class T"),
        ("model M Dropped a(redeclare K s(o = 4)); end M;", "keep k of the part s"),
        ("model M extends Dropped(redeclare K s(o = 4)); end M;", "keep k of the part s"),
        ("model M Short a(redeclare model T = Bent); end M;", "lose k of the class T"),
        ("model M Valued a(redeclare parameter Real y = 3); end M;", "lose the value of y"),
        ("model M Valued a[2](redeclare parameter Real y(min = 0) = 3); end M;", "lose the value of y"),
        ("model M extends Valued(redeclare Real v = 3); end M;", "lose the value of v"),
        ("model M Valued a(redeclare Length y); end M;", "without the attributes of Length"),
    ],
)
def test_a_modification_that_would_be_lost_or_kept_is_refused(model: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(BuildError, match=message) as caught:
        stiffnesses(SLOTS + model, tmp_path)
    assert (caught.value.file, caught.value.line) == (tmp_path / "L.mo", OWN_LINE)


@pytest.mark.parametrize(
    ("model", "k"),
    [
        ("model M Open a(redeclare K s); end M;", 3),
        ("model M Twice a; end M;", 3),
        ("model M Twice a(redeclare K s(o = 4)); end M;", 3),
        ("model M Alone a(redeclare K s); end M;", 3),
        ("model M Dropped a; end M;", 3),
        ("model M Dropped a(redeclare K s(k = 5)); end M;", 5),
        ("model M Free a(redeclare model T = Bent); end M;", 1),
        ("model M Short a; end M;", 3),
        ("model M Long a(redeclare model T = Bent); end M;", 1),
    ],
)
def test_modifications_of_what_is_replaceable_hold_as_modelica_says(model: str, k: float, tmp_path: Path) -> None:
    assert list(stiffnesses(SLOTS + model, tmp_path).values()) == [k]


def test_a_value_is_kept_that_is_given_to_the_class_of_a_redeclaration(tmp_path: Path) -> None:
    model = "model N extends Valued(redeclare parameter Real y(min = 0)); end N; "
    model += "model M N k(y = 3); extends N(y = 4); end M;"
    file = tmp_path / "L.mo"
    file.write_text(LIBRARY % (SLOTS + model), encoding="utf-8")
    values = {v.name: v.binding.value for v in load("L.M", [file]).variables if v.name.endswith("y")}
    assert values == {"k.y": 3, "y": 4}


def test_a_class_that_cannot_replace_another_is_refused_with_the_cure(tmp_path: Path) -> None:
    model = "model P extends Bare(k = 7); parameter Real o = 1; equation f = k*x + o; end P; model Q = P(o = 5); "
    model += (
        "model S replaceable model T = Bent; T s; equation s.x = 1; end S; model M S a(redeclare model T = Q); end M;"
    )
    with pytest.raises(BuildError, match=r"is not a subtype of .*; name a class that both extend behind constrainedby"):
        stiffnesses(SLOTS + model, tmp_path)


NAMESAKES = """
  model P Real x(start = 1, fixed = true); equation der(x) = 0; end P;
  model W Real x(start = 2, fixed = true); P own(x(start = 7)); P plain; equation der(x) = 0; end W;
  model V extends W; end V;
  model T W w; end T;
  model Four extends W(x(start = 4)); end Four;
""".replace("\n", " ")


@pytest.mark.parametrize(
    "model",
    [
        "model M W w(x(start = 4)); end M;",
        "model M W w[2](x(start = {4, 5})); end M;",
        "model M V v(x(start = 4)); end M;",
        "model M T t(w(x(start = 4))); end M;",
        "model M extends T(w(x(start = 4))); end M;",
    ],
)
def test_a_modification_that_a_namesake_would_take_too_is_refused(model: str, tmp_path: Path) -> None:
    with pytest.raises(BuildError, match=rf"L\.mo:{OWN_LINE}: the compiler would give x\(start = .*\) to own.x too"):
        stiffnesses(NAMESAKES + model, tmp_path)


@pytest.mark.parametrize(
    ("model", "starts"),
    [
        ("model M Four w; end M;", [4, 7, 1]),
        ("model M extends W(x(start = 4)); end M;", [4, 7, 1]),
        ("model M W w(x(start = 4), own(x(start = 9))); end M;", [4, 9, 1]),
        ("model M W w(plain(x(start = 4))); end M;", [2, 7, 4]),
    ],
)
def test_one_that_only_its_own_name_takes_holds(model: str, starts: list[int], tmp_path: Path) -> None:
    file = tmp_path / "L.mo"
    file.write_text(LIBRARY % (NAMESAKES + model), encoding="utf-8")
    assert [v.start.value for v in load("L.M", [file]).variables] == starts
