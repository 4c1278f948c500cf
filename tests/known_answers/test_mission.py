"""Known answer 0, the mission: from logs of a machine to a model of it that lacks nothing, and runs elsewhere."""

import contextlib
import io
import json
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest

from fmu_build import build
from pysim.cli import main
from pysim.effects import read_catalogue, variant
from tests.known_answers.case import CASES, read_case
from tests.known_answers.contract import broken
from tests.known_answers.plants import simulate


def _run(*words: str | Path) -> Any:
    """A command, whose answer is the JSON that its last word names."""
    said = io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
        status = main([str(word) for word in words])
    assert status == 0, said.getvalue()
    return json.loads(Path(words[-1]).read_text(encoding="utf-8"))


def test_from_logs_to_an_extended_fmu_that_agrees_with_the_machine(tmp_path: Path) -> None:
    case = read_case(CASES / "one_effect" / "friction.toml")
    data, library = case.write(tmp_path / "data"), case.plant.library
    asked = (data, "--model", case.plant.model, "--library", library)

    # Fit: the model as designed cannot follow, whatever its parameters.
    fitted = _run(
        "fit",
        *asked,
        "--free",
        "m,d,k",
        "--json",
        tmp_path / "fit.json",
    )
    assert fitted["misfit"] > 4
    refitted = {name: fitted["estimates"][name]["value"] for name in ("m", "d", "k")}
    before = case.unseen(refitted, {})
    assert before > 4

    # Diagnose: where it fails, what it lacks, how large that is.
    found = _run("diagnose", *asked, "--json", tmp_path / "answer.json")
    worst = found["where"][0]
    assert worst["error"] > 4
    assert worst["signal"] == "x"
    assert (found["verdict"], [one["effect"] for one in found["added"]]) == ("mass.friction", ["mass.friction"])
    low, high = found["added"][0]["intervals"]["F_c"]
    assert low < case.effects["mass.friction"]["F_c"] < high

    # Add: the model with it is as good as the noise allows on logs that nobody has given to the product.
    added = _run("add", *asked, "--effect", "mass.friction", "--json", tmp_path / "added.json")
    values = {name: one["value"] for name, one in added["parameters"].items()}
    own = {name: values[name] for name in ("m", "d", "k")}
    assert not list(broken(added, tmp_path))
    after = case.unseen(own, {"mass.friction": added["added"][0]["parameters"]})
    assert after < 1.02
    assert before > 4 * after

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
