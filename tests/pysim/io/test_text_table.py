"""Text tables in every dialect a bench writes, and the faults they come with."""

from pathlib import Path

import numpy as np
import pytest

from pysim.io.text_table import read_table
from pysim.types import BadInput

COLUMNS = ("a", "b", "c")


def table(tmp_path: Path, text: str, encoding: str = "utf-8") -> Path:
    path = tmp_path / "log.txt"
    path.write_bytes(text.encode(encoding))
    return path


@pytest.mark.parametrize(
    "text",
    [
        "1.5\t-2\t3e2\n4\t5\t6\n",
        "1,5\t-2\t3e2\n4\t5\t6\n",
        "1,5;-2;3e2\n4;5;6\n",
        "1.5 ; -2 ; 3e2\r\n4 ; 5 ; 6\r\n",
        "1.5,-2,3e2\n4,5,6\n",
        "1.5, -2, 3e2\n4, 5, 6\n",
        "  1.5   -2  3e2\n 4 5 6\n",
        "1,5 -2,0 3e2\n4,0 5,0 6\n",
        "# made by hand\na b c\nSampling rate 250 Hz\n\n1.5 -2 3e2\n# a pause\n4 5 6",
        "\ufeffa,b,c\n1.5,-2,3e2\n4,5,6\n",
        "a;b;c;\n1,5;-2;3e2;\n4;5;6;\n",
        "a,b,c,\n1.5,-2,3e2, \n4,5,6,\n",
        "1.5\t-2\t3e2\t\n4\t5\t6\n",
        '"a","b","c"\n"1.5","-2","3e2"\n"4","5","6"\n',
        '"a";"b";"c"\n"1,5";"-2";"3e2"\n"4";"5";"6"\n',
        '"a","b","c"\n"1,5","-2","3e2"\n"4,0","5,0","6"\n',
        '"a", "b", "c"\r\n"1,50" , -2, "3,0e2"\r\n4, "5,000", 6\r\n',
        '"1,5 -2,0 3e2"\n"4 5 6"\n',
    ],
)
def test_every_dialect_gives_the_same_numbers(tmp_path: Path, text: str) -> None:
    values, _ = read_table(table(tmp_path, text), COLUMNS, "test")
    np.testing.assert_array_equal(values, [[1.5, -2.0, 300.0], [4.0, 5.0, 6.0]])


def test_line_numbers_count_headers_and_comments(tmp_path: Path) -> None:
    _, lines = read_table(table(tmp_path, "a b c\n1 2 3\n# stop\n\n4 5 6\n"), COLUMNS, "test")
    assert lines.tolist() == [2, 5]


def test_headers_of_labview_are_skipped(tmp_path: Path) -> None:
    text = (
        "LabVIEW Measurement\t\nSeparator\tTab\n***End_of_Header***\t\n\nChannels\t2\t\nSamples\t2\t2\n"
        "X0\t0.0E+0\t0.0E+0\nDelta_X\t0.004\t0.004\n***End_of_Header***\t\t\nX_Value\tcmd\talpha\tComment\n"
        "0.000000\t25.0\t24.9\t\n0.004000\t25.5\t24.8\n"
    )
    values, lines = read_table(table(tmp_path, text), COLUMNS, "test")
    assert values.tolist() == [[0.0, 25.0, 24.9], [0.004, 25.5, 24.8]]
    assert lines.tolist() == [11, 12]


def test_latin_1_is_read(tmp_path: Path) -> None:
    values, _ = read_table(table(tmp_path, "# Öltemperatur 40 °C\n1 2 3\n", "latin-1"), COLUMNS, "test")
    assert values.tolist() == [[1.0, 2.0, 3.0]]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", r"holds no numbers; it needs rows of a, b, c$"),
        ("a b c\n# nothing\n", "holds no numbers; it needs rows of a, b, c, and ends with '# nothing'"),
        ("PK\x03\x04\0\0", r"test: .*log\.txt is no text file; export it as text"),
        ("1;2;3\n4;5;\n", "line 2: '' is no number for c"),
        ("1;2;3;\n4;5;\n", "line 2: 2 columns where 3 belong"),
        ("12:00:01 2 3\n12:00:02 2 3\n", "line 1: '12:00:01' is no number for a; write it as a number of seconds"),
        ("1 2 3\n4 5\n", r"line 2: 2 columns where 3 belong \(a, b, c\)"),
        ("1 2 3\n4\t\t6\n", "line 2: '' is no number for b"),
        ("1 2 3\n4 five 6\n", "line 2: 'five' is no number for b"),
        ("1 two 3\n4 5 6\n", "line 1: 'two' is no number for b"),
        ("1 2 3\n4 5 nan\n", "line 2: c is nan, which is not finite"),
        ("1 2 3\n-inf 5 6\n", "line 2: a is -inf, which is not finite"),
        ("1 2 3\n4 5 1_000\n", "line 2: '1_000' is no number for c"),
        ("a,b,c\n1,5,-2,0,3,0\n", r"line 2: 6 columns .* \(a, b, c\); if its commas are decimal, separate the columns"),
        ('"1,000","2,000","12,500"\n', "line 1: 6 columns where 3 belong .*; if its commas are decimal, separate"),
        ('"1,234.5","2,5","1,5"\n', "line 1: 6 columns where 3 belong .*; complete the row"),
        ("1,2,3\n1,2,3,4,5,6,7\n", "line 2: 7 columns where 3 belong .*; complete the row"),
    ],
)
def test_faults_are_named_with_their_line(tmp_path: Path, text: str, words: str) -> None:
    with pytest.raises(BadInput, match=words):
        read_table(table(tmp_path, text), COLUMNS, "test")


@pytest.mark.parametrize(
    "header",
    ["a,c,b", "# a, c, b", '"a";"c";"b"', "A [s]\tC [%]\tB (bar)", "a,c,b\ns,%,bar", "a;c;x", "a c b", "a,c,b,"],
)
def test_a_header_in_another_order_is_refused(tmp_path: Path, header: str) -> None:
    path = table(tmp_path, f"by hand\n{header}\n1\t2\t3\n")
    with pytest.raises(
        BadInput, match=r"log\.txt, line 2: the header .* order ., ., ., and test in the order a, b, c; "
    ):
        read_table(path, COLUMNS, "test")


@pytest.mark.parametrize("header", ["a b c", "a b x", "x y z", "a,b,b", "b", "c b a and more", "a_s,c_pct,b_bar"])
def test_a_header_may_call_columns_otherwise(tmp_path: Path, header: str) -> None:
    assert read_table(table(tmp_path, f"{header}\n1\t2\t3\n"), COLUMNS, "test")[0].tolist() == [[1.0, 2.0, 3.0]]


def test_a_column_left_out_may_be_headed_like_one_that_is_not(tmp_path: Path) -> None:
    path = table(tmp_path, "t,u,raw\n1,2,3\n")
    assert read_table(path, ("t", "-", "u"), "test")[0].tolist() == [[1.0, 2.0, 3.0]]


def test_a_missing_file_names_who_asked_for_it(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match=r"dataset\.toml, line 9: cannot read .*none\.txt \(No such file"):
        read_table(tmp_path / "none.txt", COLUMNS, "dataset.toml, line 9")


def test_columns_that_nobody_wants_may_hold_anything(tmp_path: Path) -> None:
    path = table(tmp_path, "day;t;ok;u\n1.3.;0,5;yes;2\n1.3.;0,6;;3\n")
    values, _ = read_table(path, ("-", "t", "-", "u"), "test")
    np.testing.assert_array_equal(values[:, [1, 3]], [[0.5, 2.0], [0.6, 3.0]])
    path.write_text('day,t,ok,u\n1,"0,5","yes, it is; so far",2\n1,"0,60","no",3\n')
    np.testing.assert_array_equal(read_table(path, ("-", "t", "-", "u"), "test")[0], values)
    path.write_text('day,t,ok,u\n1,0.5,"yes",2\n')
    with pytest.raises(BadInput, match="line 2: 'yes' is no number for ok"):
        read_table(path, ("-", "t", "ok", "u"), "test")


@pytest.mark.parametrize(
    ("text", "columns"),
    [
        ("stamp,t,u\n2024-01-01 12:00:00,0.1,1.5\n2024-01-01 12:00:01,0.2,2.5\n", ("-", "t", "u")),
        ('"stamp","t","u"\n"2024-01-01 12:00:00",0.1,1.5\n"2024-01-01 12:00:01",0.2,2.5\n', ("-", "t", "u")),
        ('"01.02.2024, 12:00:00",0.1,1.5\n"01.02.2024, 12:00:01",0.2,2.5\n', ("-", "t", "u")),
        ("01.02.2024 12:00:00;0,1;1,5;\n01.02.2024 12:00:01;0,2;2,5;\n", ("-", "t", "u")),
        ("2024-01-01 12:00:00,0.1,1.5,\n2024-01-01 12:00:01,0.2,2.5,\n", ("-", "t", "u")),
        ("t,u,state\n0.1,1.5,pump on\n0.2,2.5,off\n", ("t", "u", "-")),
        ("t,u,state\n0.1,1.5,on; ok\n0.2,2.5,\n", ("t", "u", "-")),
        ('"on; ok";0,1;1,5\n"off";0,2;2,5\n', ("-", "t", "u")),
        ("t\tu\tremark\n0.1\t1.5\t\n0.2\t2.5\t\n", ("t", "u", "-")),
        ("t\tu\tremark\n0.1\t1.5\t\n0.2\t2.5\tstop now\n", ("t", "u", "-")),
        ("t\tu\tremark\t\n0.1\t1.5\t\t\n0.2\t2.5\t\t\n", ("t", "u", "-")),
        ("2024-01-01 12:00:00 0,1 1,5\n2024-01-01 12:00:01 0,2 2,5\n", ("-", "-", "t", "u")),
    ],
)
def test_a_column_left_out_may_look_like_separators(tmp_path: Path, text: str, columns: tuple[str, ...]) -> None:
    values, _ = read_table(table(tmp_path, text), columns, "test")
    np.testing.assert_array_equal(values[:, [columns.index("t"), columns.index("u")]], [[0.1, 1.5], [0.2, 2.5]])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("2024-01-01 12:00:00,x,1.5\n2024-01-01 12:00:01,0.2,2.5\n", "line 1: 'x' is no number for t"),
        ("2024-01-01 12:00:00,0.1,1.5\n2024-01-01 12:00:01,x,2.5\n", "line 2: 'x' is no number for t"),
        ("2024-01-01 12:00:00,0.1,1.5\n2024-01-01 12:00:01,0.2\n", "line 2: 2 columns where 3 belong"),
        ("2024-01-01 12:00:00,0.1,1.5\n2024-01-01 12:00:01,0.2,inf\n", "line 2: u is inf, which is not finite"),
        ("stamp x,u,t\n2024-01-01 12:00:00,0.1,1.5\n", "line 1: the header has the columns in the order stamp x, u, t"),
    ],
)
def test_faults_beside_a_column_left_out_are_named(tmp_path: Path, text: str, words: str) -> None:
    with pytest.raises(BadInput, match=words):
        read_table(table(tmp_path, text), ("-", "t", "u"), "test")
