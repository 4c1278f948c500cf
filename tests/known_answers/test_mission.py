"""Known answer 0, the mission: from logs of a machine to a model of it that lacks nothing, and runs elsewhere."""

import contextlib
import io
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest

from fmu_build import build
from pysim.cli import main
from pysim.effects import read_catalogue, variant
from tests.known_answers.case import CASES, Case, read_case
from tests.known_answers.contract import broken
from tests.known_answers.plants import simulate


def _run(*words: str | Path) -> Any:
    """A command, whose answer is the JSON that its last word names."""
    said = io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
        status = main([str(word) for word in words])
    assert status == 0, said.getvalue()
    return json.loads(Path(words[-1]).read_text(encoding="utf-8"))


@dataclass(frozen=True)
class Mission:
    """The machine, how the product is asked about it, and what it said of the model as designed.

    Args:
        case: the machine, its truth, and logs that are in no data set.
        asked: words that every command takes.
        fitted, found: answers of `fit` and `diagnose`.
    """

    case: Case
    asked: tuple[str | Path, ...]
    fitted: Any
    found: Any

    @property
    def before(self) -> float:
        """Error over noise of the refitted model on logs that nobody has given to the product."""
        return self.case.unseen({name: self.fitted["estimates"][name]["value"] for name in ("m", "d", "k")}, {})


@pytest.fixture(scope="module")
def mission(tmp_path_factory: pytest.TempPathFactory) -> Mission:
    case, folder = read_case(CASES / "one_effect" / "friction.toml"), tmp_path_factory.mktemp("mission")
    asked = (case.write(folder / "data"), "--model", case.plant.model, "--library", case.plant.library)
    fitted = _run("fit", *asked, "--free", "m,d,k", "--json", folder / "fit.json")
    return Mission(case, asked, fitted, _run("diagnose", *asked, "--json", folder / "answer.json"))


def test_the_model_as_designed_cannot_follow_whatever_its_parameters(mission: Mission) -> None:
    assert mission.fitted["misfit"] > 4
    assert mission.before > 4
    worst = mission.found["where"][0]
    assert worst["error"] > 4
    assert worst["signal"] == "x"


def test_the_diagnosis_names_what_it_lacks_and_how_large_that_is(mission: Mission) -> None:
    found = mission.found
    assert (found["verdict"], [one["effect"] for one in found["added"]]) == ("mass.friction", ["mass.friction"])
    low, high = found["added"][0]["intervals"]["F_c"]
    assert low < mission.case.effects["mass.friction"]["F_c"] < high


def test_with_it_the_error_falls_and_its_fmu_does_what_the_machine_does(mission: Mission, tmp_path: Path) -> None:
    case, library = mission.case, mission.case.plant.library

    # Add: the model with it is as good as the noise allows on logs that nobody has given to the product.
    added = _run("add", *mission.asked, "--effect", "mass.friction", "--json", tmp_path / "added.json")
    values = {name: one["value"] for name, one in added["parameters"].items()}
    own = {name: values[name] for name in ("m", "d", "k")}
    assert not list(broken(added, tmp_path))
    after = case.unseen(own, {"mass.friction": added["added"][0]["parameters"]})
    assert after < 1.02
    assert mission.before > 4 * after

    # The extended model as an FMU does, in an importer that is not ours, what the machine does.
    chosen = [effect for effect in read_catalogue(library) if effect.name == "mass.friction"]
    made = variant(case.plant.model, chosen, [library], name="Extended", values=values)
    (tmp_path / "Extended.mo").write_text(made.text, encoding="utf-8")
    fmu = build("Extended", tmp_path / "extended.fmu", libraries=[library, tmp_path / "Extended.mo"])

    step, times, noise = 0.005, np.arange(0.0, 8.0, 0.02), case.plant.sensors["x"].noise
    command, begins = case.command(77), np.arange(0.0, 8.0, step)
    # FMPy holds the input through a step of co-simulation; the middle of the step stands for it.
    given = np.array([(t, command(t + step / 2)) for t in begins.tolist()], dtype=[("time", float), ("F", float)])
    run = fmpy.simulate_fmu(
        str(fmu), fmi_type="CoSimulation", input=given, output=["x"], stop_time=8.0, output_interval=step
    )
    truth = simulate(case.plant, case.parameters, case.effects, command, times)[:, 0]
    assert np.abs(truth).max() > 100 * noise
    assert np.interp(times, run["time"], run["x"]) == pytest.approx(truth, abs=0.5 * noise)
