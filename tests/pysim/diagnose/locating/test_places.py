"""Which place comes first, and what counts there: a term that was fitted, or an effect."""

from types import SimpleNamespace

import pytest

from pysim.diagnose.locating.found import Found, Named
from pysim.diagnose.locating.places import TIE, Place, in_order, rows

ACTED = SimpleNamespace(remembers=False, law=None)
MEMORY = SimpleNamespace(remembers=True, law=None)


def table(slot: str, evidence: float, *, fitted: bool = True, over: str = "") -> Found:
    return Found(law(slot, over), SimpleNamespace(), fitted, evidence, 0.5)


def law(slot: str, over: str) -> SimpleNamespace:
    return SimpleNamespace(slot=slot, argument=over)


def named(slot: str, evidence: float, acted: object = ACTED) -> Named:
    return Named(SimpleNamespace(slot=slot, text="an effect"), evidence, 0.9, acted)


def test_a_promise_counts_less_than_a_fit() -> None:
    places = in_order([table("a", 90.0, fitted=False), table("b", 40.0)], [named("c", 60.0)], {})
    assert [place.slot for place in places] == ["c", "b", "a"]


def test_at_one_place_the_better_fit_counts() -> None:
    assert isinstance(Place("a", table("a", 50.0), named("a", 60.0)).leads, Named)
    assert isinstance(Place("a", table("a", 70.0), named("a", 60.0)).leads, Found)
    assert isinstance(Place("a", table("a", 70.0, fitted=False), named("a", 60.0)).leads, Named)
    assert isinstance(Place("a", table("a", 70.0), None).leads, Found)


@pytest.mark.parametrize(("behind", "over"), [(0.9 * TIE, "v"), (1.1 * TIE, "x")])
def test_of_laws_as_likely_the_one_over_which_the_effect_acts_is_taken(behind: float, over: str) -> None:
    does = SimpleNamespace(remembers=False, law=law("a", "v"))
    found = [table("a", 70.0, over="x"), table("a", 70.0 - behind, over="v")]
    (place,) = in_order(found, [named("a", 60.0, does)], {})
    assert place.table is not None
    assert place.table.law.argument == over


@pytest.mark.parametrize(("ahead", "suggested"), [(-1.0, "an effect"), (0.9 * TIE, "an effect"), (1.1 * TIE, "")])
def test_an_effect_is_suggested_where_the_table_fits_no_better(ahead: float, suggested: str) -> None:
    assert Place("a", table("a", 60.0 + ahead), named("a", 60.0)).suggested == suggested
    assert Place("a", table("a", 60.0 + ahead), None).suggested == ""


@pytest.mark.parametrize(
    ("place", "by_effect"),
    [
        (Place("a", table("a", 50.0), named("a", 60.0, MEMORY)), True),
        (Place("a", table("a", 50.0), named("a", 60.0)), False),  # a table can hold it, and says more
        (Place("a", table("a", 50.0, fitted=False), named("a", 60.0)), True),
        (Place("a", table("a", 70.0), named("a", 60.0, MEMORY)), False),
        (Place("a", table("a", 50.0), named("a", 60.0, None)), False),
    ],
)
def test_what_remembers_is_drawn_as_the_effect_does_it(place: Place, by_effect: bool) -> None:
    assert place.by_effect is by_effect


def test_what_cannot_be_drawn_is_left_out() -> None:
    assert in_order([], [named("a", 60.0, None)], {}) == []
    assert [place.slot for place in in_order([table("a", 1.0)], [named("a", 60.0, None)], {})] == ["a"]


def test_ties_and_places_in_a_row_are_told(monkeypatch: pytest.MonkeyPatch) -> None:
    from pysim.diagnose.locating import places as module

    monkeypatch.setattr(module, "Missing", lambda slot, share, over, shape, text, alike, numbers: (slot, alike))
    drawn = (None, None, "", {})
    monkeypatch.setattr(module, "_by_effect", lambda base, place: drawn)
    monkeypatch.setattr(module, "_by_table", lambda base, place: drawn)
    found = in_order(
        [table("row", 10.0, fitted=False)],
        [named("a", 60.0), named("b", 60.0 - 0.9 * TIE), named("c", 60.0 - 1.1 * TIE)],
        {"a": ["row"], "row": ["a"]},
    )
    told = dict(rows(SimpleNamespace(), found))
    assert told == {"a": ("b", "row"), "b": ("a", "c"), "c": ("b",), "row": ("a",)}
