"""Each step of the diagnosis as a command of its own, and a command that was stopped."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from fmu_build import build
from pysim.cli import _diagnosis_report, main
from pysim.cli._answer_folder import MARKER
from pysim.cli._story import JOURNAL, Story
from pysim.diagnose import ledger
from pysim.diagnose import story as diagnosis_story
from pysim.identify.greybox.comparison import Compared
from pysim.io import read_model, write_dataset
from pysim.types import FrequencyResponse, MeasuredRecord, SineTest, Told
from tests.pysim.diagnose.toy import library, measured

MODEL = ["--model", "Toy.Mass", "--library", str(library())]


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("data") / "toy"
    write_dataset(folder, measured(1, "toy.friction", F_c=0.4))
    return folder


@pytest.fixture
def undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pictures cost seconds and are held to their numbers elsewhere."""
    monkeypatch.setattr(_diagnosis_report, "_figures", lambda found, dataset: iter(()))


def test_rank_tells_what_each_gains_and_decides_nothing(
    data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["diagnose", str(data), *MODEL, "--max-effects", "0", "--effects", "toy.friction,toy.bias,toy.hardening"]
    assert main([*words, "--json", str(tmp_path / "a.json")]) == 0
    found = json.loads((tmp_path / "a.json").read_text())
    assert found["ranking"][0]["effect"] == "toy.friction"
    assert len(found["ranking"]) == 3
    assert found["added"] == []
    assert [row["step"] for row in found["error"]] == ["prior", "refit"]
    said = capsys.readouterr().out
    assert "of 3 candidates gain more than their price: toy.friction (" in said
    assert "Nothing was decided." in said


def test_add_writes_the_extended_class_and_the_falling_error(
    undrawn: None, data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    output, answer = tmp_path / "out", tmp_path / "a.json"
    words = ["--effects", "toy.friction", "--effects", "toy.bias", "--output", str(output), "--json", str(answer)]
    assert main(["add", str(data), *MODEL, *words]) == 0
    found = json.loads(answer.read_text())
    assert [row["step"] for row in found["error"]] == ["prior", "refit", "toy.friction", "toy.bias"]
    refit, friction = found["error"][1:3]
    assert friction["validate"] < 1.1 < refit["validate"]
    first, second = found["added"]
    assert first["parameters"]["F_c"] == pytest.approx(0.4, abs=0.01)
    low, high = second["intervals"]["F_b"]
    assert low < 0 < high  # the bias is not there
    model = read_model(tmp_path / found["files"]["fmu"])
    assert model.name == "MassWithRubbingAndBias"
    assert model[f"{first['place']}.F_c"].start == first["parameters"]["F_c"]
    assert "Added as asked: dry friction (toy.friction) and constant force (toy.bias)." in capsys.readouterr().out
    assert "What do the effects mend?" in (output / "report.html").read_text()


@pytest.mark.parametrize(
    ("effects", "message"),
    [
        (["toy.magic"], "--effects toy.magic: not in the catalogue; it has "),
        (["friction.coulomb"], "--effects friction.coulomb: no slot of Toy.Mass takes it"),
        (["toy.bias", "toy.bias"], "named twice"),
    ],
)
def test_add_refuses_what_it_cannot_add(
    effects: list[str], message: str, data: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["add", str(data), *MODEL, *(word for name in effects for word in ("--effects", name))]) == 2
    assert message in capsys.readouterr().err


def test_a_model_without_its_class_gets_no_effect(
    data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    fmu = build("Toy.Mass", tmp_path / "mass.fmu", libraries=[library()])
    assert main(["add", str(data), "--model", str(fmu), "--effects", "toy.bias"]) == 2
    assert "its class is in none of the libraries" in capsys.readouterr().err
    assert main(["diagnose", str(data), "--model", str(fmu), "--max-effects", "0"]) == 2
    assert "class is not at hand" in capsys.readouterr().err


def test_compare_tells_how_far_the_model_is_and_where(
    undrawn: None, data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = [
        "compare",
        str(data),
        *MODEL,
        "--json",
        str(tmp_path / "a.json"),
    ]
    assert main(words) == 1
    said = capsys.readouterr().out
    assert said.startswith("As it is, the model leaves ")
    assert "Thesis Table 1.4 is not met: at worst " in said
    assert " % of full scale at most (limit 10). It fails most at " in said
    assert [row["step"] for row in json.loads((tmp_path / "a.json").read_text())["error"]] == ["prior"]
    output = tmp_path / "out"
    assert main([*words, "--refit", "--output", str(output)]) == 0
    assert "Refitted, it leaves " in capsys.readouterr().out
    found = json.loads((tmp_path / "a.json").read_text())
    prior, refit = found["error"]
    assert prior["fit"] > 1.5 * refit["fit"] > 1.5
    assert (found["verdict"], found["reason"].partition("; ")[2]) == ("unknown", "no effect was tried")
    assert found["where"][0]["error"] > refit["fit"]
    assert f"pysim compare {data} --model Toy.Mass" in (output / "report.html").read_text()
    told = ["--parameters", str(output / "parameters.toml"), "--story", str(tmp_path / "s.jsonl")]
    main([*words, *told])  # its values are those of the model that was compared
    (again,) = json.loads((tmp_path / "a.json").read_text())["error"]
    assert again["fit"] == pytest.approx(refit["fit"], rel=0.05)


def test_parameters_that_are_read_are_not_written_over(
    data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    own = tmp_path / "parameters.toml"
    own.write_text("m = 1.1\n")
    assert main(["diagnose", str(data), *MODEL, "--parameters", str(own), "--output", str(tmp_path)]) == 2
    assert "parameters.toml is read, and the new answer would replace it" in capsys.readouterr().err
    assert own.read_text() == "m = 1.1\n"


def test_tables_beside_logs_are_left_out_and_said_to_be(
    undrawn: None, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    logs = measured(1)
    size, phase = np.array([0.05, 0.06, 0.08]), np.array([-0.1, -0.4, -1.2])
    response = FrequencyResponse(np.array([0.1, 0.5, 0.7]), size, phase, SineTest(0.0, 1.0, "F", "x"), "by hand")
    table = MeasuredRecord("t.csv", "frequency-response-table", "fit", response, 0.0, 1.0)
    write_dataset(tmp_path / "both", replace(logs, records=(table, *logs.records)))
    answer = tmp_path / "a.json"
    assert main(["compare", str(tmp_path / "both"), *MODEL, "--refit", "--json", str(answer)]) == 0
    found = json.loads(answer.read_text())
    assert found["error"][-1]["fit"] == pytest.approx(1.0, abs=0.1)
    assert any("left out: tables of frequency responses (1), beside logs over time" in note for note in found["notes"])


def test_compare_does_not_pass_a_model_that_fails_in_a_record(
    data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def beside(*args: Any) -> Compared:
        found = ledger.beside(*args)
        (lost,) = (record for record in found.records if record.use == "validate")
        rest = tuple(record for record in found.records if record is not lost)
        return replace(found, records=rest, notes=(f"not simulated: {lost.source} ends early",), lost=1)

    monkeypatch.setattr(diagnosis_story, "beside", beside)
    words = ["compare", str(data), *MODEL, "--refit", "--json", str(tmp_path / "a.json")]
    assert main(words) == 1
    said = capsys.readouterr().out
    assert "Table 1.4 not judged, 1 record not simulated" in said
    assert "is met" not in said
    assert "ends early" in said
    last = json.loads((tmp_path / "a.json").read_text())["error"][-1]
    assert (last["passes"], last["not_simulated"]) == (False, 1)


def test_compare_draws_a_model_that_is_not_refitted(data: Path, tmp_path: Path) -> None:
    output = tmp_path / "out"
    words = ["compare", str(data), *MODEL, "--output", str(output)]
    assert main(words) == 1
    page = (output / "report.html").read_text()
    assert "Where the model as it is fails" in page
    assert "refitted model" not in page
    assert {"ledger.png", "map.png", "where.svg", "record_1.svg"} <= {path.name for path in output.iterdir()}


def stopped_at(step: str) -> Callable[[Story, Told], None]:
    """In place of what tells: Ctrl-C once a step of the ledger is known."""
    tell = Story.__call__

    def stop(self: Story, told: Told) -> None:
        tell(self, told)
        if told.step is not None and told.step.step == step:
            raise KeyboardInterrupt

    return stop


def test_an_answer_takes_the_place_of_the_one_before(
    undrawn: None, data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    output = tmp_path / "out"
    assert main(["add", str(data), *MODEL, "--effects", "toy.friction", "--output", str(output)]) == 0
    ours = {"report.html", "parameters.toml", MARKER}
    first = {path.name for path in output.iterdir()}
    assert first == ours | {"MassWithRubbing.mo", "MassWithRubbing.fmu"}
    words = ["compare", str(data), *MODEL, "--refit", "--output", str(output)]
    with monkeypatch.context() as patch:
        patch.setattr(Story, "__call__", stopped_at("prior"))
        assert main(words) == 2
    assert {path.name for path in output.iterdir()} == {*first, JOURNAL}
    assert main(words) == 0
    assert {path.name for path in output.iterdir()} == ours
    assert (output / "parameters.toml").read_text().startswith("# Of Toy.Mass, refitted to ")


def test_a_command_that_was_stopped_goes_on_with_the_same_answer(
    undrawn: None, data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    words = ["diagnose", str(data), *MODEL, "--effects", "toy.friction,toy.bias", "--output", str(tmp_path / "out")]
    with monkeypatch.context() as patch:
        patch.setattr(Story, "__call__", stopped_at("refit"))
        assert main(words) == 2
    assert capsys.readouterr().err.rstrip().endswith("pysim: stopped; the same command goes on where it was")
    journal = tmp_path / "out" / JOURNAL
    assert '"base"' in journal.read_text()
    assert main([*words, "--seed", "5"]) == 2
    assert "journal of another diagnosis" in capsys.readouterr().err
    assert main([*words, "--json", str(tmp_path / "a.json")]) == 0
    assert not journal.exists()
    assert main([*words[:-2], "--json", str(tmp_path / "b.json")]) == 0
    one, other = (json.loads((tmp_path / name).read_text()) for name in ("a.json", "b.json"))
    for key in ("verdict", "added", "ranking", "error", "parameters", "where"):
        assert one[key] == other[key]


def test_locate_tells_the_place_and_the_shape_of_what_is_missing(
    data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["locate", str(data), *MODEL, "--json", str(tmp_path / "a.json")]) == 0
    found = json.loads((tmp_path / "a.json").read_text())
    first = found["missing"][0]
    assert (first["slot"], first["depends_on"]) == ("force", "force.v")
    assert first["share"] > 0.95
    shape = first["shape"]
    far = [value for at, value in zip(shape["argument"], shape["value"], strict=True) if at > 0.5]
    assert far == pytest.approx([-0.4] * len(far), abs=0.03)  # dry friction of 0.4 N against the motion
    assert "What is missing fits best at force, over force.v" in capsys.readouterr().out


def test_locate_beside_the_effect_that_was_missing_finds_little(data: Path, tmp_path: Path) -> None:
    words = ["locate", str(data), *MODEL, "--with", "toy.friction", "--json", str(tmp_path / "a.json")]
    assert main(words) == 0
    found = json.loads((tmp_path / "a.json").read_text())
    assert [row["step"] for row in found["error"]] == ["prior", "refit", "toy.friction"]
    assert all(abs(value) < 0.05 for value in found["missing"][0]["shape"]["value"])


def test_an_unknown_comes_with_its_shape(data: Path, tmp_path: Path) -> None:
    words = ["diagnose", str(data), *MODEL, "--effects", "toy.bias", "--json", str(tmp_path / "a.json")]
    assert main(words) == 0
    found = json.loads((tmp_path / "a.json").read_text())
    assert found["verdict"] == "unknown"
    assert found["missing"][0]["depends_on"] == "force.v"
