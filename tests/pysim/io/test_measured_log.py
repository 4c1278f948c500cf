"""Logs over time: what they become, and what is refused with file and line."""

from pathlib import Path

import numpy as np
import pytest

from pysim.io import read_dataset
from pysim.types import BadInput

TOML = """[dataset]
name = "logs"

[signals.p]
role = "input"
unit = "bar"

[signals.speed]
role = "output"
unit = "rpm"
variable = "shaft.w"
noise = 3

[signals.u]
role = "output"
unit = "1"

[[records]]
file = "sine.txt"
columns = ["time", "speed", "p"]
kind = "frequency-response"
offset = 20
amplitude = 5.0
frequency = 2.0
use = "fit"

[[records]]
file = "wave.txt"
columns = ["p", "time", "u", "speed"]
kind = "stochastic"
use = "validate"
"""
SINE = "t n p\n0.0 60 20\n0.1 30 21\n0.2 -60 22.5\n"
WAVE = "1;-0.5;0;3\n2;0;0,25;6\n"


def files(folder: Path, toml: str = TOML, sine: str = SINE, wave: str = WAVE) -> Path:
    for name, text in (("dataset.toml", toml), ("sine.txt", sine), ("wave.txt", wave)):
        (folder / name).write_text(text, encoding="utf-8")
    return folder


def test_columns_become_signals_in_si(tmp_path: Path) -> None:
    data = read_dataset(files(tmp_path))
    sine, wave = data.logs()
    assert (sine.source, sine.kind, sine.use) == ("sine.txt", "frequency-response", "fit")
    assert (wave.source, wave.kind, wave.use) == ("wave.txt", "stochastic", "validate")
    assert (sine.data.names, sine.data.units) == (("speed", "p"), ("rad/s", "Pa"))
    np.testing.assert_array_equal(sine.data.time, [0.0, 0.1, 0.2])
    np.testing.assert_allclose(sine.data["speed"], [2 * np.pi, np.pi, -2 * np.pi])
    np.testing.assert_allclose(sine.data["p"], [20e5, 21e5, 22.5e5])
    assert (wave.data.names, wave.data.units) == (("p", "u", "speed"), ("Pa", "1", "rad/s"))
    np.testing.assert_allclose(wave.data.time, [-0.5, 0.0])
    np.testing.assert_allclose(wave.data.values, [[1e5, 0.0, 0.1 * np.pi], [2e5, 0.25, 0.2 * np.pi]])
    assert wave.data.origin == "measured, wave.txt"
    assert data.responses() == ()


def test_a_column_is_scaled_and_moved_into_the_unit_of_its_signal(tmp_path: Path) -> None:
    gauge = TOML.replace('unit = "bar"', 'unit = "bar"\nfactor = 40\noffset = 1.01325\nnoise = 0.5')  # 0 to 10 V
    turned = gauge.replace('unit = "rpm"', 'unit = "rpm"\nfactor = -1')
    data = read_dataset(files(tmp_path, turned))
    sine, wave = data.logs()
    np.testing.assert_allclose(sine.data["p"], 40e5 * np.array([20, 21, 22.5]) + 101325)
    np.testing.assert_allclose(sine.data["speed"], [-2 * np.pi, -np.pi, 2 * np.pi])
    np.testing.assert_array_equal(wave.data["u"], [0.0, 0.25])
    assert (sine.offset, sine.amplitude, data.signal("p").noise) == (20e5, 5e5, 0.5e5)  # told in bar, as the unit says
    with pytest.raises(BadInput, match=r"line 4: factor cannot be 0; write how many bar one in the column is"):
        read_dataset(files(tmp_path, gauge.replace("factor = 40", "factor = 0")))


def test_temperatures_have_zeros_of_their_own(tmp_path: Path) -> None:
    data = read_dataset(files(tmp_path, TOML.replace('unit = "bar"', 'unit = "°C"\nnoise = 0.5')))
    sine = data.logs()[0]
    assert sine.data.units == ("rad/s", "K")
    np.testing.assert_allclose(sine.data["p"], [293.15, 294.15, 295.65])
    assert (sine.offset, sine.amplitude, data.signal("p").noise) == (pytest.approx(293.15), 5.0, 0.5)


@pytest.mark.parametrize(
    ("unit", "cure"),
    [("Bar", "did you mean bar or "), ("N m", "did you mean Nm or N/m"), ("one", "use one of 1, %, %/s, s, ms")],
)
def test_a_unit_that_is_not_known_is_refused_with_those_near_it(tmp_path: Path, unit: str, cure: str) -> None:
    with pytest.raises(BadInput, match=f"line 14: unit = '{unit}' is not known; {cure}"):
        read_dataset(files(tmp_path, TOML.replace('unit = "1"', f'unit = "{unit}"')))


def test_a_record_tells_what_its_test_was_meant_to_be(tmp_path: Path) -> None:
    sine, wave = read_dataset(files(tmp_path)).logs()
    assert (sine.offset, sine.amplitude, sine.frequency) == (20e5, 5e5, 2.0)
    assert (wave.offset, wave.amplitude, wave.frequency) == (None, None, None)
    assert (sine.command, wave.command) == ("p", "p")


@pytest.mark.parametrize(
    ("begin", "seconds"),
    [("86400.5", 86400.5), ("1970-01-02T00:00:01", 86401.0), ("1970-01-02T01:00:01+01:00", 86401.0)],
)
def test_how_and_when_a_log_begins(tmp_path: Path, begin: str, seconds: float) -> None:
    toml = TOML.replace('kind = "stochastic"', f'kind = "stochastic"\ninitial = "estimate"\nbegin = {begin}')
    sine, wave = read_dataset(files(tmp_path, toml)).records
    assert (sine.initial, sine.begin) == (None, None)
    assert (wave.initial, wave.begin) == ("estimate", seconds)


def test_the_data_set_tells_inputs_from_outputs(tmp_path: Path) -> None:
    data = read_dataset(files(tmp_path))
    assert data.columns(data.records[1], "input") == ("p",)
    assert data.columns(data.records[1], "output") == ("u", "speed")


def test_the_description_itself_may_be_named(tmp_path: Path) -> None:
    assert read_dataset(files(tmp_path) / "dataset.toml").name == "logs"


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('"time", "speed", "p"]', '"speed", "p"]', r'toml, line 18: columns names no "time"'),
        ('"time", "speed", "p"]', '"time", "speed", "q"]', r"line 18: the column 'q' is no signal; add \[signals\.q\]"),
        ('"time", "speed", "p"]', '"time", "p", "p"]', "line 18: columns names 'p' 2 times; name it once"),
        ('"time", "speed", "p"]', '"time", "speed", "u"]', "line 18: none of the columns time, speed, u is an input"),
        ('"time", "speed", "p"]', '"time", "p"]', "line 18: none of the columns time, p is an output"),
        ('["time", "speed", "p"]', '"time"', "line 18: columns is missing or no row of texts"),
        ("frequency = 2.0\n", "", 'line 18: frequency is missing, and kind = "frequency-response" needs it'),
        ("amplitude = 5.0\n", "", "line 18: amplitude is missing"),
        ("amplitude = 5.0", "amplitude = -5.0", "line 18: amplitude must be positive, got -5"),
        ("frequency = 2.0", "frequency = 0", "line 18: frequency must be positive, got 0"),
        ("frequency = 2.0", "frequency = 5.1", r"line 18: frequency = 5\.1 Hz is not below half .*sine\.txt, 10 Hz"),
        ("frequency = 2.0", "frequency = 5", r"line 18: frequency = 5 Hz is not below half .*sine\.txt, 10 Hz"),
        ('kind = "stochastic"', 'kind = "chirp"', 'line 27: offset is missing, and kind = "chirp" needs it'),
        ('kind = "stochastic"', 'kind = "step"\nfrequency = 1', "line 27: frequency belongs to kind"),
        (
            'kind = "stochastic"',
            'kind = "step"\noutput = "u"',
            'line 27: output means nothing where kind = "step"; remove it',
        ),
        ('kind = "stochastic"\n', "", "line 27: kind is missing"),
        ("[signals.u]", "[signals.speed]", r"dataset\.toml: .*line 14"),
        ('"wave.txt"', '"waves.txt"', r"line 27: cannot read .*waves\.txt \(No such file"),
        ('role = "output"\nunit = "1"', 'unit = "1"', "line 14: role is missing"),
        ('["p", "time", "u", "speed"]', '["p", "time", "u", "speed", "x"]', "line 27: the column 'x' is no signal"),
    ],
)
def test_refuses_faults_in_the_description(tmp_path: Path, old: str, new: str, words: str) -> None:
    assert TOML.count(old) == 1
    with pytest.raises(BadInput, match=words):
        read_dataset(files(tmp_path, TOML.replace(old, new)))


def test_times_in_ms(tmp_path: Path) -> None:
    in_ms = "t n p\n0 60 20\n100 30 21\n200 -60 22.5\n"
    with pytest.raises(
        BadInput, match=r'half .*sine\.txt, 0\.01 Hz; .*or tell that time is in ms: \[dataset\] time_unit = "ms"'
    ):
        read_dataset(files(tmp_path, sine=in_ms))
    toml = TOML.replace("[dataset]", '[dataset]\ntime_unit = "ms"')
    np.testing.assert_allclose(read_dataset(files(tmp_path, toml, in_ms)).logs()[0].data.time, [0.0, 0.1, 0.2])
    with pytest.raises(BadInput, match="time_unit = 'day' is not known; use one of s, ms, us, ns, min, h"):
        read_dataset(files(tmp_path, TOML.replace("[dataset]", '[dataset]\ntime_unit = "day"')))


@pytest.mark.parametrize(("unit", "of_a_second"), [("us", 1e6), ("µs", 1e6), ("min", 1 / 60), ("h", 1 / 3600)])
def test_times_in_other_units(tmp_path: Path, unit: str, of_a_second: float) -> None:
    rows = "".join(f"{0.1 * k * of_a_second:.12g} {60 - k} {20 + k}\n" for k in range(3))
    toml = TOML.replace("[dataset]", f'[dataset]\ntime_unit = "{unit}"')
    wave = WAVE.replace("2;", "9;", 1)
    data = read_dataset(files(tmp_path, toml, rows, wave))
    np.testing.assert_allclose(data.logs()[0].data.time, [0.0, 0.1, 0.2], atol=1e-9)


def test_a_single_repeated_row_is_a_slip(tmp_path: Path) -> None:
    rows = [f"{0.1 * k:.1f} {k} 20" for k in range(60)]
    with pytest.raises(BadInput, match=r"line 32: time stands still at 3 s; remove the repeated rows"):
        read_dataset(files(tmp_path, sine="\n".join([*rows[:31], *rows[30:]])))


def test_columns_to_leave_out(tmp_path: Path) -> None:
    toml = TOML.replace('["time", "speed", "p"]', '["-", "time", "speed", "-", "p"]')
    sine = "at\tt\tn\tok\tp\n12:00\t0,0\t60\tyes\t20\n12:00\t0,1\t30\tyes\t21\n12:01\t0,2\t-60\tno\t22,5\n"
    data = read_dataset(files(tmp_path, toml, sine)).logs()[0].data
    assert data.names == ("speed", "p")
    np.testing.assert_array_equal(data.values, read_dataset(files(tmp_path)).logs()[0].data.values)


def test_folders_may_be_parted_by_either_slash(tmp_path: Path) -> None:
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "sine.txt").write_text(SINE)
    toml = TOML.replace('"sine.txt"', r'"sub\\sine.txt"')
    assert read_dataset(files(tmp_path, toml)).records[0].source == "sub/sine.txt"
    with pytest.raises(BadInput, match=r"line 18: file = 'sub\\test\.txt' is no name; write / between folders"):
        read_dataset(files(tmp_path, TOML.replace('"sine.txt"', r'"sub\test.txt"')))
    with pytest.raises(BadInput, match="write / between folders"):
        read_dataset(files(tmp_path, TOML.replace('"sine.txt"', r'"sub\sine.txt"')))


def test_a_sine_below_half_the_sampling_rate_is_read(tmp_path: Path) -> None:
    assert read_dataset(files(tmp_path, TOML.replace("frequency = 2.0", "frequency = 4.9"))).records[0].frequency == 4.9


def test_a_log_named_twice_is_refused(tmp_path: Path) -> None:
    again = TOML[TOML.index("[[records]]") : TOML.rindex("[[records]]")].replace("sine.txt", "./sine.txt")
    with pytest.raises(BadInput, match=r"line 33: sine\.txt is the record of line 18 already; name each file once"):
        read_dataset(files(tmp_path, TOML + "\n" + again))


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("time speed p\n# nothing came\n", r"sine\.txt holds no numbers"),
        ("t n p\n0 1 2\n", r"sine\.txt, line 2: the log holds a single row"),
        ("t n p\n0 1 2\n0.1 open 2\n", r"sine\.txt, line 3: 'open' is no number for speed"),
        ("0 1 2\n0.1 1 1e999\n", "line 2: p is 1e999, which is not finite"),
        ("0 1 2\n\n0.1 1 2\n# again\n0.1 1 2\n", r"sine\.txt, line 5: time stands still at 0\.1 s; log it"),
        (
            "0 1 2\n0 1 2\n0.1 1 2\n0.1 1 2\n",
            "line 2: time stands still at 0 s; log it with more digits, or correct which",
        ),
        ("t n p\n0 1 2\n0.1 1 2\n0 1 2\n", r"sine\.txt, line 4: time runs backwards from 0\.1 s to 0 s"),
    ],
)
def test_refuses_faults_in_a_log(tmp_path: Path, text: str, words: str) -> None:
    with pytest.raises(BadInput, match=words):
        read_dataset(files(tmp_path, sine=text))


def test_which_input_the_numbers_speak_of_must_be_clear(tmp_path: Path) -> None:
    two = TOML.replace('[signals.u]\nrole = "output"', '[signals.u]\nrole = "input"')
    two = two.replace('columns = ["time", "speed", "p"]', 'columns = ["time", "speed", "p", "u"]')
    sine = "0 0 20 1\n0.1 0 20 1\n"
    with pytest.raises(BadInput, match="line 18: offset and amplitude of which input, p or u"):
        read_dataset(files(tmp_path, two, sine))
    for name, factor in (("p", 1e5), ("u", 1.0)):
        toml = two.replace("offset = 20", f'input = "{name}"\noffset = 20')
        record = read_dataset(files(tmp_path, toml, sine)).records[0]
        assert (record.offset, record.amplitude, record.command) == (20 * factor, 5 * factor, name)


def test_reading_neither_writes_nor_needs_to(tmp_path: Path) -> None:
    folder = files(tmp_path)
    paths = [folder, *sorted(folder.iterdir())]
    for path in reversed(paths):
        path.chmod(0o555 if path.is_dir() else 0o444)
    before = [(p.stat().st_mtime_ns, p.stat().st_mode, p.read_bytes() if p.is_file() else b"") for p in paths]
    try:
        read_dataset(folder)
        after = [(p.stat().st_mtime_ns, p.stat().st_mode, p.read_bytes() if p.is_file() else b"") for p in paths]
        assert before == after
        assert [folder, *sorted(folder.iterdir())] == paths
    finally:
        folder.chmod(0o755)


@pytest.mark.parametrize("dialect", ["\t", ";decimal comma", "with a pause"])
def test_a_log_of_many_rows_is_read_in_any_dialect(tmp_path: Path, dialect: str) -> None:
    values = np.random.default_rng(4).integers(-99999, 99999, size=(5000, 2)) / 1000
    rows = [f"{0.004 * i:.3f}\t{a:.3f}\t{b:.3f}" for i, (a, b) in enumerate(values.tolist())]
    text = "time\tspeed\tp\n" + "\n".join(rows) + "\n"
    if dialect == "with a pause":
        text = text.replace("\n10.000\t", "\n# oil too warm\n\n10.000\t")
    if dialect == ";decimal comma":
        text = text.replace("\t", ";").replace(".", ",")
    data = read_dataset(files(tmp_path, sine=text))
    np.testing.assert_allclose(data.logs()[0].data["p"], 1e5 * values[:, 1], rtol=1e-15)


@pytest.mark.parametrize(
    ("rate", "digits", "frequency", "readable"),
    [(60, 2, 28, True), (60, 2, 31, False), (70, 2, 34, True), (70, 2, 36, False), (240, 4, 120, False)],
)
def test_the_sampling_rate_is_known_from_printed_times(
    tmp_path: Path, rate: int, digits: int, frequency: int, readable: bool
) -> None:
    rows = "".join(f"{k / rate:.{digits}f} {k % 7} {k % 5}\n" for k in range(200))
    folder = files(tmp_path, TOML.replace("frequency = 2.0", f"frequency = {frequency}"), rows)
    if readable:
        assert read_dataset(folder).logs()[0].frequency == frequency
        return
    with pytest.raises(BadInput, match=f"frequency = {frequency} Hz is not below half the sampling rate of "):
        read_dataset(folder)
