"""Tables print within what a noun may take, and pandas does the rest."""

import math
import pickle
from html.parser import HTMLParser

import pytest

from pysim.nouns.table import MOST, Table
from pysim.types import BadInput

SMALL = Table.of(("name", "value", "is on"), [("m", 1.5, True), ("k", None, False)], key="name")
LARGE = Table.of(("name", "text"), [(f"p{k}", "<&>" * 40) for k in range(500)], key="name", title="all of them")


def test_columns_and_rows_are_found_by_name() -> None:
    assert (len(SMALL), SMALL["value"], SMALL.row("m")["value"]) == (2, (1.5, None), 1.5)
    for ask, said in ((lambda: SMALL["mass"], "name, value, is on"), (lambda: SMALL.row("d"), "m, k")):
        with pytest.raises(BadInput, match=said):
            ask()


def test_numbers_stand_to_the_right_and_nothing_is_written_for_none() -> None:
    assert repr(SMALL).splitlines() == ["name  value  is on", "m       1.5  yes", "k            no"]


def test_the_ends_of_a_narrow_interval_are_told_apart() -> None:
    rows = [(4e-12, 4e-12 - 3e-18, 4e-12 + 3e-18), (1.0, 0.9, 1.1), (2.0, math.nan, 2.0), (2.0, 2.0, 2.0)]
    table = Table.of(("value", "95 % from", "to"), rows)
    assert [line.split() for line in repr(table).splitlines()[1:]] == [
        ["4e-12", "3.999997e-12", "4.000003e-12"], ["1", "0.9", "1.1"], ["2", "2"], ["2", "2", "2"]
    ]  # fmt: skip
    assert "<td>3.999997e-12</td>" in table._repr_html_()


def test_a_large_table_says_how_much_it_leaves_out() -> None:
    text, page = repr(LARGE), LARGE._repr_html_()
    assert max(len(text), len(page)) < 2000
    left = int(text.splitlines()[-1].split()[2])
    assert left == 500 - (len(text.splitlines()) - 2)
    assert len(text) + 60 > MOST  # it is as long as it may be


def test_html_holds_its_texts_and_no_more_tags_than_it_should() -> None:
    found: list[str] = []

    class Reader(HTMLParser):
        def handle_starttag(self, tag: str, attrs: object) -> None:
            found.append(tag)

    Reader().feed(LARGE._repr_html_())
    assert set(found) == {"table", "caption", "tr", "th", "td"}


def test_it_can_be_copied_and_kept() -> None:
    assert pickle.loads(pickle.dumps(SMALL)) == SMALL


def test_pandas_answers_what_the_table_does_not() -> None:
    pandas = pytest.importorskip("pandas")
    frame = SMALL.to_dataframe()
    assert isinstance(frame, pandas.DataFrame)
    assert frame.loc["m", "value"] == 1.5
    assert list(SMALL.query("value > 1").index) == ["m"]
