"""`pysim multisine` on records and data sets of a system with a known gain and a known square."""

import json
from pathlib import Path

import numpy as np
import pytest

from pysim.cli import main
from pysim.io import write_record
from pysim.present.report import MARKER
from pysim.types import Record
from tests.pysim.identify.multisine.systems import ODD, PERIOD, N, gain, multisine, through, with_free_lines

FREE = with_free_lines(ODD, seed=11)
NAMES = ["--input", "u", "--signal", "y"]


def log(seed: int, scale: float = 1.0) -> Record:
    """Rest, then three and a half periods around an offset, then a way back; the square shows on even lines."""
    rng = np.random.default_rng(seed)
    wave = scale * multisine(FREE, rng)
    answer = through(wave) + 0.05 * through(wave) ** 2
    body = np.tile(np.stack([wave, answer], -1), (4, 1))[N // 2 :]
    lead, back = np.zeros((300, 2)), np.linspace(body[-1], 0, 100)
    values = np.concatenate([lead, body, back]) + 0.003 * rng.standard_normal((body.shape[0] + 400, 2)) * [0, 1]
    return Record(PERIOD / N * np.arange(values.shape[0]), values, ("u", "y"), ("%", "%"))


@pytest.fixture(scope="module")
def records(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    folder = tmp_path_factory.mktemp("records")
    paths = [folder / f"r{i}.npz" for i in range(3)]
    for i, path in enumerate(paths):
        write_record(log(i), path)
    return [str(path) for path in paths]


def test_several_records_are_realisations(records: list[str], tmp_path: Path) -> None:
    out, numbers = tmp_path / "out", tmp_path / "x.json"
    words = ["multisine", *records, "--period", "2", *NAMES, "--drop", "0"]
    assert main([*words, "--json", str(numbers), "--output", str(out)]) == 0
    data = json.loads(numbers.read_text())["approximations"][0]
    assert data["method"].startswith("robust")
    assert (data["test"]["realisations"], data["test"]["periods"]) == (3, 3)
    found = np.array(data["gain_real"]) + 1j * np.array(data["gain_imag"])
    np.testing.assert_allclose(found, gain(FREE), atol=6 * np.sqrt(np.max(data["variance"])))
    np.testing.assert_allclose(data["frequency_hz"], FREE / PERIOD)
    assert data["levels"]["even"]["p_value"] < 1e-6
    assert {path.name for path in out.iterdir()} == {"report.html", "multisine_1.png", "multisine_1.svg", MARKER}


@pytest.mark.parametrize(
    ("more", "method", "periods"),
    [(["--period", "2", "--periods", "2"], "fast", 2), (["--band", "1", "20"], "local polynomial", 1)],
)
def test_one_record_takes_what_it_allows(
    records: list[str], tmp_path: Path, more: list[str], method: str, periods: int
) -> None:
    """Without a period any signal will do."""
    assert main(["multisine", records[0], *NAMES, *more, "--json", str(tmp_path / "x.json")]) == 0
    (found,) = json.loads((tmp_path / "x.json").read_text())["approximations"]
    assert (found["method"].split(":")[0], found["test"]["periods"]) == (method, periods)


def test_lines_can_be_named(records: list[str], tmp_path: Path) -> None:
    numbers = tmp_path / "x.json"
    words = ["multisine", *records, "--period", "2", *NAMES, "--json", str(numbers), "--lines"]
    assert main([*words, ",".join(str(k) for k in FREE)]) == 0
    assert json.loads(numbers.read_text())["approximations"][0]["frequency_hz"] == (FREE / PERIOD).tolist()
    assert main([*words, "1,95-99:4"]) == 0
    assert json.loads(numbers.read_text())["approximations"][0]["frequency_hz"] == [0.5, 47.5, 49.5]


def test_files_of_one_name_both_have_a_result(tmp_path: Path) -> None:
    paths = [tmp_path / name / "log.npz" for name in ("a", "b")]
    for seed, path in enumerate(paths):
        path.parent.mkdir()
        write_record(log(seed), path)
    words = ["multisine", *map(str, paths), *NAMES, "--output", str(tmp_path / "out")]
    assert main([*words, "--json", str(tmp_path / "x.json")]) == 0
    found = json.loads((tmp_path / "x.json").read_text())["approximations"]
    assert [one["name"] for one in found] == [str(path) for path in paths]
    assert (tmp_path / "out" / "report.html").read_text().count("<img") == 2


def data_set(folder: Path) -> Path:
    rows = []
    for amplitude in (5, 10):
        for i in range(2):
            name = f"a{amplitude}_{i}.txt"
            record = log(i, amplitude / 5)
            lines = [f"{t:.6f}\t{u:.8f}\t{y:.8f}" for t, (u, y) in zip(record.time, record.values, strict=True)]
            (folder / name).write_text("\n".join(lines) + "\n")
            rows.append(
                f'[[records]]\nfile = "{name}"\ncolumns = ["time", "u", "y"]\nkind = "other"\noffset = 0\n'
                f"amplitude = {amplitude}\n"
            )
    signals = "".join(
        f'[signals.{name}]\nrole = "{role}"\nunit = "%"\n\n' for name, role in (("u", "input"), ("y", "output"))
    )
    (folder / "dataset.toml").write_text('[dataset]\nname = "known"\n\n' + signals + "\n".join(rows))
    return folder


def test_a_data_set_has_a_result_per_working_point(tmp_path: Path) -> None:
    (tmp_path / "measured").mkdir()
    folder, numbers = data_set(tmp_path / "measured"), tmp_path / "x.json"
    assert main(["multisine", str(folder), "--period", "2", "--json", str(folder / "dataset.json")]) == 2
    assert main(["multisine", str(folder), "--period", "2", "--json", str(numbers)]) == 0
    found = json.loads(numbers.read_text())["approximations"]
    assert [f["name"] for f in found] == ["u around 0 %, rms 1.27 %", "u around 0 %, rms 2.55 %"]
    assert [f["test"]["realisations"] for f in found] == [2, 2]
    assert main(["multisine", str(folder), "--period", "2", "--records", "a5_0*", "--json", str(numbers)]) == 0
    assert json.loads(numbers.read_text())["approximations"][0]["test"]["realisations"] == 1


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--period", "2"], "--input NAME --signal NAME"),
        ([*NAMES, "--period", "1.7"], "does not repeat itself"),
        ([*NAMES, "--method", "robust"], "write --period SECONDS"),
        (["--input", "u", "--signal", "z", "--period", "2"], "no signal 'z'"),
        ([*NAMES, "--period", "2", "--periods", "9"], "9 periods are asked for"),
        ([*NAMES, "--period", "2", "--lines", "1,3,9999"], "line 9999 is not below half of"),
        ([*NAMES, "--period", "2", "--lines", "1,x"], "'x' is no harmonic; write numbers"),
        ([*NAMES, "--lines", "1,3"], "--lines goes with --period SECONDS"),
        ([*NAMES, "--period", "2", "--method", "arbitrary", "--drop", "1"], "--drop goes with --period SECONDS"),
        ([*NAMES, "--period", "2", "--band", "1", "20"], "--band goes without a period"),
        ([*NAMES, "--records", "a*"], "--records chooses among the logs of a data set"),
    ],
)
def test_wrong_use(records: list[str], words: list[str], message: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["multisine", records[0], *words]) == 2
    assert message in capsys.readouterr().err


def test_a_data_set_without_such_logs(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["multisine", str(data_set(tmp_path)), "--period", "2", "--records", "b*"]) == 2
    assert "name the logs" in capsys.readouterr().err


def test_the_period_of_a_multisine_is_not_forgotten(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Without it the gain between the lines would be rubbish that looks like a result."""
    toml = data_set(tmp_path) / "dataset.toml"
    toml.write_text(toml.read_text().replace('"other"', '"multisine"'))
    assert main(["multisine", str(tmp_path)]) == 2
    assert "a5_0.txt is a multisine; write its period, --period SECONDS" in capsys.readouterr().err
    assert main(["multisine", str(tmp_path), "--method", "arbitrary"]) == 0
