"""What the page of candidates offers."""

import pytest

from pysim.app.pages.candidates import occupied

EFFECTS = [{"name": name, "slot": slot} for name, slot in (("a", "force"), ("b", "force"), ("c", "flow"))]


@pytest.mark.parametrize(
    ("pairs", "others"), [([], ["a"]), ([["force"]], []), ([["force", "b", "a"]], []), ([["flow"]], ["a"])]
)
def test_an_effect_is_not_offered_where_its_slot_is_taken(pairs: list[list[str]], others: list[str]) -> None:
    model = {"effects": EFFECTS, "pairs": pairs}
    assert occupied(model, "b", ("a",)) == others
    assert occupied(model, "b", ()) == occupied(model, "c", ("a",)) == []
