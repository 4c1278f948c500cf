"""What separates the fields of a line, and what is a number."""

import pytest

from pysim.io.text_fields import COMMAS, dialect, number, row_fields, without_end_mark


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("1\t2,5;3", ("\t", True)),
        ("1;2,5", (";", True)),
        ("1,2", (",", False)),
        ("1, 2", (",", False)),
        ("1 ,2", (",", False)),
        ("1,5 2", (None, True)),
        ("1 2", (None, True)),
    ],
)
def test_the_dialect_of_a_line(line: str, expected: tuple[str | None, bool]) -> None:
    assert dialect(line) == expected


@pytest.mark.parametrize(
    ("line", "columns", "fields"),
    [
        ("2024-01-01 12:00:00,0.1,1.5", ("-", "t", "u"), ["2024-01-01 12:00:00", "0.1", "1.5"]),
        ("0.1,1.5,pump on", ("t", "u", "-"), ["0.1", "1.5", "pump on"]),
        ("0.1,1.5,on; ok", ("t", "u", "-"), ["0.1", "1.5", "on; ok"]),
        ("0,1;1,5;a\tb", ("t", "u", "-"), ["0.1", "1.5", "a\tb"]),
        ("1\t2\t", ("t", "u", "-"), ["1", "2", ""]),
        ("\t1\t2", ("-", "t", "u"), ["", "1", "2"]),
        ("2024-01-01 12:00:00 0,1 1,5", ("-", "-", "t", "u"), ["2024-01-01", "12:00:00", "0.1", "1.5"]),
        ("1,5 2", ("t", "u"), ["1.5", "2"]),
    ],
)
def test_a_row_is_split_as_its_columns_ask_for(line: str, columns: tuple[str, ...], fields: list[str]) -> None:
    assert row_fields(line, columns)[0] == fields


def test_the_dialect_of_the_file_tells_where_none_fits() -> None:
    assert row_fields("2024-01-01 12:00:02,x", ("-", "t"), COMMAS) == (["2024-01-01 12:00:02", "x"], COMMAS)


def test_an_end_mark_is_taken_off_once() -> None:
    assert [without_end_mark(line) for line in ("1;2;", "1;2;; ", "1,2", "1\t")] == ["1;2", "1;2;", "1,2", "1"]


@pytest.mark.parametrize(("field", "value"), [("1e3", 1000.0), ("1_000", None), ("", None), ("12:00", None)])
def test_what_a_number_is(field: str, value: float | None) -> None:
    assert number(field) == value
