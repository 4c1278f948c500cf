"""How answers of the blind benchmark are counted."""

from dataclasses import asdict, replace
from json import dumps, loads

from validation.blind.benchmark.answer import Answer, read_answer
from validation.blind.benchmark.case import choose
from validation.blind.benchmark.figures import figures, page
from validation.blind.plant import cases

NAMED = Answer("1/n", "named", ("a",), (), ("a",), complete=True, errors={"refit": 2.0, "a": 0.1}, detectability=500.0)
ANSWERS = (
    NAMED,
    replace(NAMED, named=("b",), second=("b", "a"), ties=(("b", "a"),), errors={"refit": 0.3, "b": 0.6}),
    replace(NAMED, named=("b",), second=("b", "c"), detectability=20.0),
    replace(NAMED, kind="pair", truth=("a", "b"), named=("b", "a")),
    replace(NAMED, kind="pair", truth=("a", "b"), remaining=30.0),
    replace(NAMED, kind="pair", truth=("a", "b"), remaining=300.0),
    replace(NAMED, kind="pair", truth=("a", "b"), named=("a", "c"), remaining=30.0),
    replace(NAMED, kind="beyond", truth=("x",), named=(), complete=False),
    replace(NAMED, kind="beyond", truth=("x",), named=(), detectability=20.0),
    replace(NAMED, kind="left-out", truth=("y",), named=(), learned=("force",)),
    replace(NAMED, kind="none", truth=(), named=(), sensors=("sensor.offset",)),
    replace(NAMED, kind="none", truth=(), named=(), nuisances=("shift",), sensors=("sensor.delay",)),
    replace(NAMED, kind="shaped", errors={"refit": None, "a": 0.1}),
    replace(NAMED, kind="none", truth=(), named=("b",), complete=False),
    Answer("1/t", "", trouble="ended"),
)


def test_what_is_counted() -> None:
    found = {share.label: (share.hits, share.of) for share in figures(ANSWERS)}
    assert found["right effect named first, detectability 100 or more"] == (1, 2)
    assert found["right effect among the first two, detectability 100 or more"] == (2, 2)
    assert found["another named first, in a tie with the right one, detectability 100 or more"] == (1, 2)
    assert found["a wrong effect named, detectability below 100"] == (1, 1)
    assert found["two effects at once, both named"] == (1, 4)
    assert found["the same, without pairs of which less than 100 remains"] == (1, 3)
    assert found["an effect outside the catalogue answered with unknown"] == (2, 2)
    assert found["a physical effect named although none is missing"] == (1, 3)
    assert found["said to be incomplete although nothing is missing"] == (1, 3)
    assert found["right effect named first though its law has another shape"] == (1, 1)
    assert found["a sensor's error named that is not there"] == (1, 15)
    assert found["residual on unseen logs at most 1.05 of the noise once named"] == (8, 9)
    assert found["a step that raised the residual on unseen logs"] == (1, 15)
    assert found["cases without an answer"] == (1, 15)
    assert any("no answer" in line for line in page(ANSWERS, "title"))


def test_a_line_is_read_as_it_was_written() -> None:
    assert read_answer(loads(dumps(asdict(ANSWERS[1])))) == ANSWERS[1]


def test_the_first_cases_stand_for_the_whole_table() -> None:
    table = cases(7)
    first = choose(table, 7, count=60)
    kinds = {f"7/{case.name}": case.kind for case in table}
    chosen = [kinds[name] for name in first]
    for kind in set(chosen):
        assert abs(4 * chosen.count(kind) - sum(case.kind == kind for case in table)) <= 4
    assert choose(table, "7-few", names="named-oil*", count=1)[0].startswith("7-few/named-oil")
