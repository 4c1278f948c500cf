"""A draw has no thing twice, is the same for the same seed, and in the long run leaves nothing out."""

from validation.drawn import drawn

THINGS = [f"case {i}" for i in range(20)]


def test_a_draw_is_bound_to_its_seed() -> None:
    one = drawn(THINGS, 5, seed=3)
    assert len(set(one)) == 5
    assert one == drawn(THINGS, 5, seed=3)
    assert one != drawn(THINGS, 5, seed=4)


def test_of_few_things_all_are_drawn() -> None:
    assert sorted(drawn(THINGS[:3], 5, seed=1)) == THINGS[:3]
    assert drawn([], 5, seed=1) == []


def test_everything_has_its_turn() -> None:
    assert set().union(*(drawn(THINGS, 5, seed=day) for day in range(60))) == set(
        THINGS
    )  # a set of seeds leaves one out with a chance of 6e-7
