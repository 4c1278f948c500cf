"""A data check in words and numbers: faults stand out, and long lists are cut in the terminal only."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from pysim.identify.data_check import check_dataset
from pysim.present import Drawing, write_report
from pysim.present.data_check import data, page, text
from pysim.present.data_check.words import columns_words, uses_words
from pysim.types import Dataset, MeasuredRecord, MeasuredSignal, Record

SIGNALS = (MeasuredSignal("cmd", "input", "1", "", "cmd", noise=0.5), MeasuredSignal("y", "output", "1", "<y>", "y"))


def dataset(count: int) -> Dataset:
    """Logs with a gap after 0.49 s each."""
    time = np.delete(np.arange(200) / 100, range(50, 60))
    log = Record(time, np.column_stack([np.sin(time), np.cos(time)]), ("cmd", "y"), ("1", "1"))
    return Dataset(
        "d", "words", "s", SIGNALS, tuple(MeasuredRecord(f"{k}.txt", "other", "fit", log) for k in range(count))
    )


def test_few_warnings_are_all_shown() -> None:
    shown = text(check_dataset(dataset(2)))
    assert shown.endswith(
        "2 warnings:\n  0.txt: a gap in time, of 0.11 s after 0.49 s\n  1.txt: a gap in time, of 0.11 s after 0.49 s\n"
        "to cure, in Python or with `pysim data prepare`:\n  data = data.fill_gaps(0.016)  # --step fill_gaps:0.016"
    )
    assert "  cmd  input, 1, noise 0.5, no resolution specified" in shown.splitlines()


def test_many_warnings_are_cut_in_the_terminal_and_whole_elsewhere() -> None:
    check = check_dataset(dataset(30))
    assert "\n  and 10 more\n" in text(check)
    found = data(check)
    assert found["warnings"] == 30
    assert found["records"][29]["clock"]["gaps"][0]["after_s"] == 0.49
    html = page(check, [Drawing("logs", "a picture", b"<svg/>")], "pysim data check d")
    assert html.count("a gap in time") == 30
    assert "&lt;y&gt;" in html
    assert "<y>" not in html
    assert "30 warnings." in html


def test_a_good_set_is_ready() -> None:
    time = np.arange(200) / 100
    log = Record(time, np.column_stack([np.sin(time), np.cos(time)]), ("cmd", "y"), ("1", "1"))
    good = Dataset("d", "words", "s", SIGNALS, (MeasuredRecord("a.txt", "other", "fit", log),))
    assert text(check_dataset(good)).endswith("0 warnings, ready to use")
    assert "ready to use" in page(check_dataset(good), [], "x")


def test_pressures_of_sines_are_told_in_bar() -> None:
    time = np.arange(400) / 100
    signals = (MeasuredSignal("p", "input", "Pa", "", "p"), MeasuredSignal("y", "output", "1", "", "y"))
    sine = 1e7 + 1e6 * np.sin(2 * np.pi * time)
    log = Record(time, np.column_stack([sine, np.cos(time)]), ("p", "y"), ("Pa", "1"))
    sines = MeasuredRecord("a.txt", "frequency-response", "fit", log, 1e7, 1e6, 1.0, command="p")
    shown = text(check_dataset(Dataset("d", "-", "-", signals, (sines,))))
    assert "offset 100 bar, amplitude 10 bar: 1 Hz" in shown


def test_sines_on_several_inputs_are_told_apart() -> None:
    time = np.arange(400) / 100
    signals = (*(MeasuredSignal(name, "input", "Pa", "", name) for name in ("p", "q")), SIGNALS[1])
    sine = 1e7 + 1e6 * np.sin(2 * np.pi * time)

    def record(command: str, frequency: float) -> MeasuredRecord:
        log = Record(time, np.column_stack([sine, np.cos(time)]), (command, "y"), ("Pa", "1"))
        return MeasuredRecord("a.txt", "frequency-response", "fit", log, 1e7, 1e6, frequency, command=command)

    check = check_dataset(Dataset("d", "-", "-", signals, tuple(record(c, f) for f in (1.0, 2.0) for c in "pq")))
    shown = text(check)
    for name in "pq":
        assert f"  {name} at offset 100 bar, amplitude 10 bar: 1, 2 Hz;" in shown
    assert shown.count("amplitude 10 bar") == 2
    assert [one["input"] for one in data(check)["records"]] == ["p", "q", "p", "q"]
    assert "<th>input</th>" in page(check, [], "x")


def test_a_reader_hears_of_a_log_to_choose_with_only_where_it_matters() -> None:
    assert ("No log is used to choose" in uses_words(["fit", "test"]), "No log" in uses_words(["validate"])) == (
        True,
        False,
    )
    assert columns_words(1, 2, "a.csv").startswith("1 log, 2 columns, as a.csv has them.")
    assert ("used to choose" in columns_words(2, 2, "a.csv"), "used" in columns_words(1, 2, "a.csv")) == (True, False)


def test_a_name_with_dollars_is_drawn_as_it_is(tmp_path: Path) -> None:
    one = dataset(1)
    named = replace(one, records=(replace(one.records[0], source="a$_$.txt"),))
    assert write_report(tmp_path, check_dataset(named))["logs"].is_file()
