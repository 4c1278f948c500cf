"""Reading in one go means the same as reading line by line, in every dialect and with every fault."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pysim.io import text_table
from pysim.io.text_block import read_block
from pysim.io.text_fields import LEFT_OUT, row_fields
from pysim.io.text_table import read_table
from pysim.types import BadInput

NUMBERS = st.floats(-1e300, 1e300)
FORMS = st.sampled_from(["{!r}", "{:.4f}", "{:g}", "{:+.3e}", "{:.1f}"])
WORDS = st.text("xyzäÖ°µ _()[]/%;,.\t", max_size=20)  # a header holds no numbers
SEPARATORS = st.sampled_from(["\t", ";", ",", " ", "   ", " ; ", ", ", "\t "])


@st.composite
def logs(draw: st.DrawFn) -> tuple[str, list[list[float]], str]:
    """Text of a log, its numbers, and an encoding."""
    width = draw(st.integers(2, 4))
    separator, form = draw(SEPARATORS), draw(FORMS)
    comma = draw(st.booleans()) and "," not in separator
    header = ["t" + word for word in draw(st.lists(WORDS, max_size=3))]
    rows = draw(st.lists(st.lists(NUMBERS, min_size=width, max_size=width), min_size=1, max_size=5))
    lines = [f"# {word}" for word in draw(st.lists(WORDS, max_size=2))] + header
    expected = []
    for row in rows:
        fields = [form.format(value) for value in row]
        expected.append([float(field) for field in fields])
        text = separator.join(fields)
        lines.append(text.replace(".", ",") if comma else text)
        lines += draw(st.sampled_from([[], [], [""], ["# pause"], ["  "]]))
    end = draw(st.sampled_from(["\n", "\r\n", "\r"]))
    text = end.join(lines) + draw(st.sampled_from(["", end]))
    return text, expected, draw(st.sampled_from(["utf-8", "utf-8-sig", "latin-1", "utf-16"]))


@settings(max_examples=60)
@given(logs())
def test_every_dialect_gives_the_numbers_that_were_written(
    tmp_path_factory: pytest.TempPathFactory, log: tuple[str, list[list[float]], str]
) -> None:
    text, expected, encoding = log
    path = tmp_path_factory.mktemp("log") / "log.txt"
    path.write_bytes(text.encode(encoding))
    values, numbers = read_table(path, ("t", "a", "b", "c")[: len(expected[0])], "test")
    np.testing.assert_array_equal(values, expected)
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    assert numbers.size == len(expected)
    assert all(not lines[k - 1].lstrip().startswith("#") and lines[k - 1].strip() for k in numbers)


CHARACTERS = st.text("0123456789.,;\t eE+-_#ab\n", max_size=60)


@settings(max_examples=100)
@given(CHARACTERS, st.integers(1, 3))
def test_in_one_go_and_line_by_line_agree_on_anything(text: str, width: int) -> None:
    lines = [line for line in ("1 2 3"[: 2 * width - 1] + "\n" + text).split("\n") if line.strip()]
    names = ("a", "b", "c")[:width]
    values = read_block(lines, names)
    if values is None:
        return
    slow = [text_table._row(line.strip(), names, "x") for line in lines]
    np.testing.assert_array_equal(values, slow)


@pytest.mark.parametrize("separator", ["\t", ";", ", ", " "])
def test_ordinary_logs_take_the_fast_way(separator: str) -> None:
    lines = [separator.join(("2.0", "-1.5e3", "+.5")), "", separator.join(("2.004", "7", "8"))]
    values = read_block(lines, ("a", "b", "c"))
    assert values is not None
    np.testing.assert_array_equal(values, [[2, -1500, 0.5], [2.004, 7, 8]])
    if "," not in separator:
        values = read_block([line.replace(".", ",") for line in lines], ("a", "b", "c"))
        assert values is not None
        np.testing.assert_array_equal(values, [[2, -1500, 0.5], [2.004, 7, 8]])


@pytest.mark.parametrize(
    "second",
    ["1 nan", "1 inf", "1 1e999", "1 2 3", "1", "1 x", "1 1_0", "1\t2", "1;2", "1, 2", "1 2,", "# 1 2", "1 ٣", "1 2 #"],
)
def test_anything_unusual_is_left_to_the_careful_reader(second: str) -> None:
    assert read_block(["1 2,5", second], ("a", "b")) is None


MIXED = st.text("0123456789.,; \teE+-_:ab", max_size=12)
FIELDS = st.sampled_from(["1", "2.5", "3,5", "1e999", "x", "", "1_0", "0x10", "nan", "1d5"])


@settings(max_examples=100)
@given(
    st.lists(st.tuples(MIXED, st.sampled_from(["1", "2.5", "3,5", "1e999", "x", "", "1_0"])), max_size=4), SEPARATORS
)
def test_in_one_go_and_line_by_line_agree_where_columns_are_left_out(rows: list[tuple[str, str]], by: str) -> None:
    names = (LEFT_OUT, "a", LEFT_OUT, "b")
    lines = [by.join(("", "1", "word", "2")), *(by.join((word, field, word, "2")) for word, field in rows)]
    values = read_block(lines, names)
    if values is None:
        return
    _, usual = row_fields(lines[0], names)
    slow = np.array([text_table._row(line, names, "x", usual) for line in lines])
    np.testing.assert_array_equal(values[:, [1, 3]], slow[:, [1, 3]])


@pytest.mark.parametrize("separator", ["\t", ";", ",", ", "])
def test_words_in_columns_that_are_left_out_are_no_obstacle(separator: str) -> None:
    lines = [
        separator.join(("2024-01-01 12:00:00", "0.5", "", "2")),
        separator.join(("noon; or later", "1", "on", "-3e1")),
    ]
    lines = [line.replace("; ", " ") if ";" in separator else line for line in lines]
    values = read_block(lines, ("-", "t", "-", "u"))
    assert values is not None
    np.testing.assert_array_equal(values[:, [1, 3]], [[0.5, 2], [1, -30]])


@settings(max_examples=40)
@given(
    st.integers(1, 30),  # above it all could be header
    st.integers(0, 2),
    st.sampled_from(["x1", "nan", "-inf", "1e999", "1_0", "", "1.2.3", "--5", "0x10", "1e"]),
    st.sampled_from(["\t", ";", ","]),
)
def test_the_line_of_a_fault_is_named(
    tmp_path_factory: pytest.TempPathFactory, row: int, column: int, fault: str, separator: str
) -> None:
    rows = [["0.5", "1", "2"] for _ in range(31)]
    rows[row][column] = fault
    path = tmp_path_factory.mktemp("log") / "log.txt"
    path.write_text("t a b\n" + "\n".join(separator.join(fields) for fields in rows) + "\n")
    with pytest.raises(BadInput, match=rf"log\.txt, line {row + 2}: "):
        read_table(path, ("t", "a", "b"), "test")
