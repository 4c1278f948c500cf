import contextlib

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from fmu_build.version import version
from pysim.io import read_record, record_data, record_text, write_record
from pysim.types import BadInput, Outcome, Record

_numbers = st.floats(allow_nan=False, allow_infinity=False)


def record(values: np.ndarray, **rest) -> Record:
    names = tuple(f"a[{i},1].b" for i in range(values.shape[1]))
    return Record(np.arange(len(values)) / 3, values, names, ("bar",) * len(names), **rest)


_STOPPED = record(
    np.array([[1.0, 2.0], [3.0, 4.0]]),
    outcome=Outcome.NOT_FINITE,
    message="it said:\nno",
    origin="simulated pump",
    statistics={"steps": 7},
)


@given(
    hnp.arrays(float, hnp.array_shapes(min_dims=2, max_dims=2, max_side=4), elements=_numbers),
    st.sampled_from(["csv", "npz"]),
)
def test_numbers_come_back_bit_for_bit(tmp_path_factory, values, suffix):
    path = tmp_path_factory.mktemp("records") / f"r.{suffix}"
    written = record(values)
    write_record(written, path)
    back = read_record(str(path))
    np.testing.assert_array_equal(back.values, written.values)
    np.testing.assert_array_equal(back.time, written.time)
    assert (back.names, back.units) == (written.names, written.units)


def test_npz_keeps_everything(tmp_path):
    write_record(_STOPPED, tmp_path / "r.npz")
    back = read_record(tmp_path / "r.npz")
    assert (back.outcome, back.message, back.origin) == (_STOPPED.outcome, _STOPPED.message, _STOPPED.origin)
    assert back.statistics == _STOPPED.statistics


def test_csv_opens_in_a_spreadsheet(tmp_path):
    write_record(_STOPPED, tmp_path / "r.csv")
    lines = (tmp_path / "r.csv").read_text().splitlines()
    assert lines == [
        f"# simulated pump: a value is no longer finite. it said: no [pysim {version()}]",
        'time [s],"a[0,1].b [bar]","a[1,1].b [bar]"',
        "0.0,1.0,2.0",
        "0.3333333333333333,3.0,4.0",
    ]


@pytest.mark.parametrize("outcome", Outcome)
@pytest.mark.parametrize(("origin", "message"), [("simulated pump", "it said: no"), ("", ""), ("a: b", "")])
def test_csv_keeps_how_a_run_ended(tmp_path, outcome, origin, message):
    write_record(record(np.ones((2, 1)), outcome=outcome, origin=origin, message=message), tmp_path / "r.csv")
    back = read_record(tmp_path / "r.csv")
    assert (back.outcome, back.origin, back.message) == (outcome, origin, message)
    assert record_text(back) == (tmp_path / "r.csv").read_text()


@pytest.mark.parametrize("note", ["by hand", "the test is done. it was cold", ""])
def test_a_first_line_of_another_hand_is_the_origin(tmp_path, note):
    (tmp_path / "r.csv").write_text(f"# {note}\ntime [s],x [m]\n0,1\n")
    back = read_record(tmp_path / "r.csv")
    assert (back.outcome, back.message, back.origin) == (Outcome.DONE, "", note)


def test_empty_record_survives(tmp_path):
    write_record(record(np.zeros((0, 2))), tmp_path / "r.csv")
    assert read_record(tmp_path / "r.csv").values.shape == (0, 2)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "line 1: column names"),
        ("time [s],alpha\n0,1\n", "line 1: column names"),
        ("# x\ntime [s],alpha [deg]\n0,1\n1,one\n", "line 4: could not convert"),
        ("time [s],alpha [deg]\n0,1,2\n", "line 2: 3 entries, but 2 columns"),
        ("time [ms],alpha [deg]\n0,1\n10,2\n", r"line 1: the first column is 'time \[ms\]', and 'time \[s\]' belongs"),
        ("# x\nx [m],time [s]\n0,1\n1,2\n", r"line 2: the first column is 'x \[m\]', .*; put the times first, in s"),
    ],
)
def test_broken_csv_is_said_with_its_line(tmp_path, text, words):
    (tmp_path / "r.csv").write_text(text)
    with pytest.raises(BadInput, match=words):
        read_record(tmp_path / "r.csv")


def test_a_byte_order_mark_means_nothing(tmp_path):
    (tmp_path / "r.csv").write_text("time [s],alpha [deg]\n0,1\n", encoding="utf-8-sig")
    assert read_record(tmp_path / "r.csv").names == ("alpha",)


def test_wrong_places_and_forms_are_refused(tmp_path):
    with pytest.raises(BadInput, match=r"\.csv or \.npz"):
        write_record(_STOPPED, tmp_path / "r.xlsx")
    with pytest.raises(BadInput, match="cannot write there"):
        write_record(_STOPPED, tmp_path / "nowhere" / "r.csv")
    with pytest.raises(BadInput, match="cannot be read"):
        read_record(tmp_path / "r.npz")
    (tmp_path / "r.npz").write_bytes(b"no")
    with pytest.raises(BadInput, match="not a record"):
        read_record(tmp_path / "r.npz")


def test_json_has_a_row_per_name_and_no_infinity():
    data = record_data(record(np.array([[1.0, np.nan], [3.0, np.inf]]), origin="simulated pump"))
    assert data["signals"] == {"a[0,1].b": [1.0, 3.0], "a[1,1].b": [None, None]}
    assert (data["time"], data["units"], data["origin"]) == ([0.0, 1 / 3], ["bar", "bar"], "simulated pump")


def test_text_is_what_the_file_holds(tmp_path):
    write_record(_STOPPED, tmp_path / "r.csv")
    assert (tmp_path / "r.csv").read_text() == record_text(_STOPPED)


def test_times_that_do_not_increase_are_said_with_the_file(tmp_path):
    (tmp_path / "r.csv").write_text("time [s],alpha [deg]\n0,1\n0,2\n")
    with pytest.raises(BadInput, match=r"r\.csv: record: times must be finite and increase"):
        read_record(tmp_path / "r.csv")


def test_damaged_npz_is_refused_whatever_the_damage(tmp_path):
    path = tmp_path / "r.npz"
    write_record(_STOPPED, path)
    whole = path.read_bytes()
    for at in range(0, len(whole), 7):
        path.write_bytes(whole[:at] + bytes([whole[at] ^ 0x55]) + whole[at + 1 :])
        with contextlib.suppress(BadInput):  # nothing else may be raised; damage to what nobody reads goes unnoticed
            assert read_record(path).names == _STOPPED.names
