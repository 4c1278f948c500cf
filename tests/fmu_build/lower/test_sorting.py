"""Matching and block order, against networkx-free brute force on small seeded graphs."""

from itertools import permutations
from random import Random

from fmu_build.lower.sorting import Matching, blocks


def largest_matching(unknowns_of: list[list[int]], n: int) -> int:
    """By trying every assignment."""
    return max(sum(order[e] in unknowns for e, unknowns in enumerate(unknowns_of)) for order in permutations(range(n)))


def test_matching_is_as_large_as_possible():
    random = Random(1)
    for _ in range(200):
        n = 5
        unknowns_of = [sorted(random.sample(range(n), random.randint(0, 3))) for _ in range(n)]
        matching = Matching(n)
        failed = [e for e in range(n) if matching.add(e, unknowns_of)]
        assert n - len(failed) == largest_matching(unknowns_of, n)
        for unknown, equation in enumerate(matching.equation_of):
            assert equation < 0 or unknown in unknowns_of[equation]


def test_an_equation_with_an_unknown_of_its_own_does_not_walk_the_others():
    class Unwalked(list):
        def __iter__(self):
            raise AssertionError("walked")

    matching = Matching(3)
    matching.equation_of = Unwalked(matching.equation_of)
    assert [matching.add(e, [[0], [0, 1], [1, 2]]) for e in range(3)] == [set()] * 3
    assert [matching.equation_of[k] for k in range(3)] == [0, 1, 2]


def test_an_unknown_that_was_given_to_an_equation_can_be_given_up():
    """Equation 1 was given unknown 1 and takes unknown 2, the one that came later."""
    matching = Matching(2)
    matching.grow()
    matching.match(1, 1)
    assert matching.add(0, [[1], [1, 2]]) == set()
    assert matching.equation_of == [-1, 0, 1]
    assert matching.add(2, [[1], [1, 2], [2]]) == {0, 1, 2}


def test_a_failure_names_equations_with_too_few_unknowns():
    unknowns_of = [[0], [0, 1], [1], [2]]
    matching = Matching(3)
    assert [matching.add(e, unknowns_of) for e in (0, 1, 3)] == [set(), set(), set()]
    assert matching.add(2, unknowns_of) == {0, 1, 2}


def test_blocks_are_the_cycles_in_an_order_that_can_be_solved():
    random = Random(2)
    for _ in range(200):
        n = 7
        successors = [sorted(random.sample(range(n), random.randint(0, 2))) for _ in range(n)]
        reach = [[i == j or j in successors[i] for j in range(n)] for i in range(n)]
        for k in range(n):
            for i in range(n):
                for j in range(n):
                    reach[i][j] = reach[i][j] or (reach[i][k] and reach[k][j])
        order = blocks(successors)
        assert sorted(member for block in order for member in block) == list(range(n))
        place = {member: k for k, block in enumerate(order) for member in block}
        for i in range(n):
            for j in range(n):
                assert (place[i] == place[j]) == (reach[i][j] and reach[j][i])
                assert not reach[i][j] or place[j] <= place[i]
