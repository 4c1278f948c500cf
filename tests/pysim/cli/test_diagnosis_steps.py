"""Each step of the diagnosis as a command of its own."""

import json
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pysim.cli import main
from pysim.diagnosis import error_history
from pysim.identify.greybox.comparison import Compared
from pysim.io import read_model, write_dataset
from pysim.present import diagnosis
from pysim.present.progress import Unfolding
from pysim.present.report import CHECKPOINT, MARKER
from pysim.types import FrequencyResponse, MeasuredRecord, Note, NoteCode, ProgressEvent, SineTest
from pysim.workflow import inside, session
from tests.pysim.cli.ran import Ran, refused
from tests.pysim.diagnosis_answer import found_offset
from tests.toy import measured


@pytest.fixture
def unpictured(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is plotted either."""
    monkeypatch.setattr(diagnosis, "figures", lambda result: iter(()))


def stopped_at(step: str) -> Callable[[Unfolding, ProgressEvent], None]:
    """In place of what shows progress: Ctrl-C once a step of the error history is known."""
    tell = Unfolding.__call__

    def stop(self: Unfolding, event: ProgressEvent) -> None:
        tell(self, event)
        if event.step is not None and event.step.step == step:
            raise KeyboardInterrupt

    return stop


def test_a_command_that_was_stopped_goes_on_with_the_same_answer(
    unpictured: None, compared: Ran, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    output = tmp_path / "out"
    words = [*compared.words, "--output", str(output)]
    with monkeypatch.context() as patch:
        patch.setattr(Unfolding, "__call__", stopped_at("prior"))
        assert main(words) == 2
    assert "the same command goes on" in capsys.readouterr().err
    assert [path.name for path in output.iterdir()] == [CHECKPOINT]
    refused([*words, "--free", "m"], capsys, CHECKPOINT, "delete it")
    assert main([*words, "--json", str(tmp_path / "a.json")]) == 0
    assert not (output / CHECKPOINT).exists()
    again = json.loads((tmp_path / "a.json").read_text())
    for key in ("verdict", "error", "parameters", "where"):
        assert again[key] == compared.answer[key]


def test_add_writes_the_extended_class_and_the_falling_error_in_place_of_an_earlier_answer(
    unpictured: None, compared: Ran, rubbing: Path, toy: list[str], tmp_path: Path
) -> None:
    output, answer = Path(shutil.copytree(compared.output, tmp_path / "out")), tmp_path / "a.json"
    words = ["add", str(rubbing), *toy, "--effects", "toy.friction,toy.bias"]
    assert main([*words, "--output", str(output), "--json", str(answer)]) == 0
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
    name = "MassWithRubbingAndBias"
    assert {path.name for path in output.iterdir()} == {
        "report.html",
        "parameters.toml",
        f"{name}.mo",
        f"{name}.fmu",
        "Toy.mo",
        MARKER,
    }


def test_compare_tells_how_far_the_model_is_and_where(compared: Ran) -> None:
    found = compared.answer
    prior, refit = found["error"]
    assert compared.code == 0
    assert prior["fit"] > 1.5 * refit["fit"] > 1.5
    assert found["verdict"] == "unknown"
    assert found["where"][0]["error"] > refit["fit"]
    assert (prior["criteria"], refit["criteria"]) == ({}, {})  # the thesis' limits are for its pump
    assert "Table 1." not in (compared.output / "report.html").read_text()
    assert {path.name for path in compared.output.iterdir()} == {"report.html", "parameters.toml", MARKER}


def test_what_was_fitted_is_compared_as_it_was_found(
    compared: Ran, rubbing: Path, toy: list[str], tmp_path: Path
) -> None:
    output, records = tmp_path / "out", tmp_path / "r.npz"
    own = ["--parameters", str(compared.output / "parameters.toml"), "--events", str(tmp_path / "s.jsonl")]
    own += ["--json", str(tmp_path / "a.json"), "--output", str(output), "--records", str(records)]
    assert main(["compare", str(rubbing), *toy, *own]) == 0
    (again,) = json.loads((tmp_path / "a.json").read_text())["error"]
    assert again["fit"] == pytest.approx(compared.answer["error"][-1]["fit"], rel=0.05)
    assert records.is_file()
    assert all(json.loads(line)["stage"] for line in (tmp_path / "s.jsonl").read_text().splitlines())
    assert not (output / "parameters.toml").exists()  # nothing was refitted
    assert {"error.png", "map.png", "record_1.svg"} <= {path.name for path in output.iterdir()}


@pytest.mark.parametrize("is_pump", [True, False])
def test_a_pump_that_misses_a_limit_is_exit_1(
    rubbing: Path, toy: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, is_pump: bool
) -> None:
    monkeypatch.setattr(session, "inside", lambda *given: replace(inside(*given), is_thesis_pump=is_pump))
    assert main(["compare", str(rubbing), *toy, "--json", str(tmp_path / "a.json")]) == is_pump
    (prior,) = json.loads((tmp_path / "a.json").read_text())["error"]
    assert (prior["step"], prior["passes"], bool(prior["criteria"])) == ("prior", not is_pump, is_pump)


def test_tables_beside_logs_are_left_out_and_said_to_be(toy: list[str], tmp_path: Path) -> None:
    logs = measured(1)
    size, phase = np.array([0.05, 0.06, 0.08]), np.array([-0.1, -0.4, -1.2])
    response = FrequencyResponse(np.array([0.1, 0.5, 0.7]), size, phase, SineTest(0.0, 1.0, "F", "x"), "by hand")
    table = MeasuredRecord("t.csv", "frequency-response-table", "fit", response, 0.0, 1.0)
    write_dataset(tmp_path / "both", replace(logs, records=(table, *logs.records)))
    answer = tmp_path / "a.json"
    assert main(["compare", str(tmp_path / "both"), *toy, "--refit", "--json", str(answer)]) == 0
    found = json.loads(answer.read_text())
    assert found["error"][-1]["fit"] == pytest.approx(1.0, abs=0.1)
    assert any("tables of frequency responses (1)" in note["text"] for note in found["notes"])


def test_compare_does_not_pass_a_model_that_fails_in_a_record(
    rubbing: Path, toy: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    original = error_history.beside

    def beside(*args: Any) -> Compared:
        found = original(*args)
        (lost,) = (record for record in found.records if record.use == "validate")
        rest = tuple(record for record in found.records if record is not lost)
        return replace(
            found,
            records=rest,
            notes=(Note(NoteCode.NOT_SIMULATED, {"record": lost.source, "reason": "ends early"}),),
            lost=1,
        )

    monkeypatch.setattr(error_history, "beside", beside)
    assert main(["compare", str(rubbing), *toy, "--refit", "--json", str(tmp_path / "a.json")]) == 1
    found = json.loads((tmp_path / "a.json").read_text())
    assert (found["error"][-1]["passes"], found["error"][-1]["not_simulated"]) == (False, 1)
    assert any("ends early" in note["text"] for note in found["notes"])


def test_locate_tells_the_place_and_the_shape_of_what_is_missing(rubbing: Path, toy: list[str], tmp_path: Path) -> None:
    assert main(["locate", str(rubbing), *toy, "--json", str(tmp_path / "a.json")]) == 0
    first = json.loads((tmp_path / "a.json").read_text())["missing"][0]
    assert first["slot"] == "force"
    assert first["factor"] == "sign(v)"
    assert first["share"] > 0.95
    assert first["shape"]["value"] == pytest.approx([-0.4] * len(first["shape"]["value"]), abs=0.02)  # dry friction, N


def test_locate_hands_on_the_effects_that_the_model_has(
    rubbing: Path, toy: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    handed = []

    def located(_: object, effects: Any, **__: object) -> Any:
        handed.extend(effect.name for effect in effects)
        return found_offset()

    monkeypatch.setattr("pysim.diagnosis.learn", located)
    words = ["locate", str(rubbing), *toy, "--with", "toy.friction,toy.bias", "--json", str(tmp_path / "a.json")]
    assert main(words) == 0
    assert handed == ["toy.friction", "toy.bias"]


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (["add"], ["--effects"]),
        (["add", "--effects", "toy.magic"], ["effect toy.magic", "it has"]),
        (["add", "--effects", "friction.coulomb"], ["effect friction.coulomb", "its slots take"]),
        (["add", "--effects", "toy.bias,toy.bias"], ["effect toy.bias", "name each effect once"]),
        (["locate", "--with", "toy.magic"], ["effect toy.magic", "it has"]),
        (["locate", "--effects", "toy.bias"], ["--effects"]),
        (["compare", "--free", "m"], ["--free", "add that, or leave --free out"]),
        (["compare", "--bounds", "m=1:2"], ["--bounds", "add that, or leave --bounds out"]),
    ],
)
def test_mistakes_are_one_line(
    rubbing: Path, toy: list[str], words: list[str], named: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    refused([words[0], str(rubbing), *toy, *words[1:]], capsys, *named)


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (["add", "--effects", "toy.bias", "--free", "m"], ["its class is in none of the libraries", "--library"]),
        (["diagnose", "--max-effects", "0", "--free", "m", "--bounds", "m=0.5:5"], ["class is not at hand"]),
        (["diagnose"], ["--free m --bounds m=0.1:10"]),
        (["compare", "--refit"], ["--free m --bounds m=0.1:10"]),
    ],
)
def test_what_an_fmu_of_another_tool_cannot_have_is_said(
    rubbing: Path, foreign: Path, words: list[str], named: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    refused([words[0], str(rubbing), "--model", str(foreign), *words[1:]], capsys, *named)
