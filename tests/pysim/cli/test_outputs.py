"""Where a command may leave its results: never in what was measured."""

from pathlib import Path

import pytest

from pysim.cli import main
from pysim.cli.outputs import prepare_file, prepare_folder
from pysim.types import BadInput
from tests.pysim.cli.ran import refused

TOML = """[dataset]
name = "d"
[signals.u]
role = "input"
unit = "%"
[signals.y]
role = "output"
unit = "%"
[[records]]
file = "1Hz.csv"
columns = ["time", "u", "y"]
kind = "frequency-response"
offset = 0
amplitude = 1
frequency = 1
"""


@pytest.fixture
def data(tmp_path: Path) -> Path:
    folder = tmp_path / "d"
    folder.mkdir()
    (folder / "dataset.toml").write_text(TOML)
    (folder / "1Hz.csv").write_text("\n".join(f"{k / 100},{k % 7},{k % 5}" for k in range(600)))
    return folder


COMMANDS = {
    "frf": ["frf", "{}"],
    "blackbox": ["blackbox", "{}", "--poles", "1"],
    "chirp": ["chirp", "{}"],
    "friction": ["friction", "{}", "--speed", "u", "--supply", "y", "--inertia", "1"],
    "fit": ["fit", "other", "{}", "--model", "m.fmu", "--free", "m"],
    "compare": ["compare", "{}", "--model", "m.fmu"],
    "diagnose": ["diagnose", "{}", "--model", "m.fmu"],
    "locate": ["locate", "{}", "--model", "m.fmu"],
    "add": ["add", "{}", "--model", "m.fmu", "--effects", "e"],
    "data check": ["data", "check", "{}"],
}
MORE = [("compare", "--records", "r.npz"), ("diagnose", "--events", "s.jsonl")]
PLACES = [(name, option, "x.json") for name in COMMANDS for option in ("--json", "--output")]


def test_two_results_are_not_written_to_one_file(
    data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    one = tmp_path / "one.json"
    words = ["compare", str(data), "--model", "m.fmu", "--events", str(one)]
    refused([*words, "--json", str(tmp_path / "new" / ".." / "one.json")], capsys, "--json", "--events")
    assert [path.name for path in tmp_path.iterdir()] == ["d"]
    if Path("/dev/null").exists():
        refused([*words[:-1], "/dev/null", "--json", "/dev/null"], capsys, "m.fmu")


@pytest.mark.parametrize(("command", "option", "name"), [*PLACES, *MORE])
def test_nothing_is_written_into_the_data_set(
    data: Path, command: str, option: str, name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    before = {path: path.read_bytes() for path in data.rglob("*") if path.is_file()}
    words = [word.format(data) for word in COMMANDS[command]]
    assert main([*words, option, str(data / "new" / name)]) == 2
    said = capsys.readouterr().err
    assert f"{option} {data / 'new' / name}: inside the data set, which is never written to" in said
    assert {path: path.read_bytes() for path in data.rglob("*") if path.is_file()} == before
    assert not (data / "new").exists()


def test_the_measurements_themselves_are_not_overwritten(data: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for place in (data, data / "dataset.toml"):
        assert main(["frf", str(place), "--json", str(data / "dataset.toml")]) == 2
        assert "inside the data set" in capsys.readouterr().err
    assert (data / "dataset.toml").read_text() == TOML
    log = data / "1Hz.csv"
    with pytest.raises(BadInput, match="this is what is read, and would be lost"):
        prepare_file(log, "--output", (".csv",), read=[log])


def test_an_input_is_not_overwritten_by_the_run(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    from pysim.io import read_model
    from tests.toy import base

    file = tmp_path / "F.csv"
    file.write_text("0,0\n1,1\n")
    assert read_model(base().path)["F"].causality == "input"
    assert main(["simulate", str(base().path), "--input", f"F={file}", "--output", str(file)]) == 2
    assert "this is what is read, and would be lost" in capsys.readouterr().err
    assert file.read_text() == "0,0\n1,1\n"


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["frf", "{}", "--json", "n.txt"], "--json n.txt: the suffix chooses the form; write one of .json"),
        (["compare", "{}", "--model", "m.fmu", "--records", "r.csv"], "--records r.csv: the suffix chooses the form"),
        (["diagnose", "{}", "--model", "m.fmu", "--events", "s.txt"], "write one of .jsonl, .json"),
    ],
)
def test_a_suffix_of_another_form_is_refused(
    data: Path, words: list[str], message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    monkeypatch.chdir(tmp_path)
    assert main([word.format(data) for word in words]) == 2
    assert message in capsys.readouterr().err


def test_beside_the_data_set_all_is_well(data: Path, tmp_path: Path) -> None:
    assert prepare_folder(tmp_path / "d-report", read=[data]).is_dir()  # begins alike
    assert prepare_file(tmp_path / "n.json", "--json", (".json",), read=[data]) == tmp_path / "n.json"
    device = Path("/dev/null")
    if device.exists():
        assert prepare_file(device, "--json", (".json",), read=[data]) == device
