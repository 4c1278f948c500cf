"""What a diagnosis is given, what is held right, and how an answer is judged; data sets are made up."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from pysim.types import BadInput, Dataset
from validation.asked import Step, Subject
from validation.initial_states.mass import TRUTH, force, logged, mass_model, measured, motion
from validation.mismatch.answer import Answer
from validation.mismatch.case import ENVIRONMENT, run
from validation.mismatch.judge import RISE, judged
from validation.mismatch.tasks import Right, Task, read_task

WITHHELD = "stochastic/Tp0.5_heldout.txt"


@pytest.mark.parametrize(
    ("right", "named", "complete", "faults"),
    [
        (Right((("a",),)), ["a"], None, 0),
        (Right((("a", "b"),)), ["b"], True, 0),
        (Right((("a",),), ("c",)), ["a", "c"], True, 0),
        (Right((("a",),)), ["a", "c"], True, 1),
        (Right((("a",),)), ["c", "a"], True, 1),
        (Right((("a",),)), [], False, 1),
        (Right((("a",), ("b",))), ["a"], False, 1),
        (Right((("a", "b"), ("a", "b"))), ["b", "a"], True, 0),
        (Right(()), [], False, 0),
        (Right(()), ["a"], False, 1),
        (Right((), unknown=True), [], True, 1),
        (Right((), unknown=True), [], False, 0),
    ],
)
def test_names_in_order(right: Right, named: list[str], complete: bool | None, faults: int) -> None:
    assert len(right.wrong(named, complete)) == faults


def pump_set(folder: Path, name: str, files: tuple[str, ...], truth: dict[str, object]) -> None:
    """A data set of pump logs that all read the same few numbers."""
    lines = [f'[dataset]\nname = "{name}"', '[signals.alphaCMD]\nrole = "input"\nunit = "%"']
    lines += [
        f'[signals.{s}]\nrole = "output"\nunit = "{u}"\nnoise = 1' for s, u in (("alphaPercent", "%"), ("u", "1"))
    ]
    for file in files:
        path = folder / name / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("0 0 1 0\n1 1 2 0.1\n2 1 4 0\n3 0 3 0.2\n", encoding="utf-8")
        lines.append(f'[[records]]\nfile = "{file}"\ncolumns = ["time", "alphaCMD", "alphaPercent", "u"]')
        lines.append(f'kind = "stochastic"\nuse = "{"fit" if "fit" in file else "validate"}"')
    (folder / name / "dataset.toml").write_text("\n".join(lines), encoding="utf-8")
    (folder / f"{name}.truth.json").write_text(json.dumps(truth), encoding="utf-8")


def test_the_second_wave_is_withheld_and_the_noise_can_be(tmp_path: Path) -> None:
    truth = {"effect": "x", "accepted": ["x", "y"], "harmless": ["z"], "noise_percent": 0.1, "noise_u": 0.002}
    pump_set(tmp_path, "m", ("chirp.txt", "stochastic/fit.txt", WITHHELD), truth)
    task = read_task(tmp_path, "m")
    uses = {record.source: record.use for record in task.dataset.records}
    assert uses == {"chirp.txt": "validate", "stochastic/fit.txt": "fit", WITHHELD: "test"}
    assert [record.source for record in task.given.records] == ["chirp.txt", "stochastic/fit.txt"]
    assert task.right == Right((("x", "y"),), ("z",))
    assert task.noise == {"alphaPercent": 0.1, "u": 0.002}
    assert task.given.signal("u").noise == 1
    assert read_task(tmp_path, "m", specified=False).given.signal("u").noise is None


@pytest.mark.parametrize(
    ("effect", "right"),
    [
        ("none", Right(())),
        ("unknown", Right((), unknown=True)),
        ("x", Right((("x",),))),
        (["x", "y"], Right((("x", "y"), ("x", "y")))),
    ],
)
def test_truths_without_accepted_names(tmp_path: Path, effect: object, right: Right) -> None:
    pump_set(tmp_path, "b", (WITHHELD, "fit.txt"), {"effect": effect, "noise_percent": 0.1, "noise_u": 0.002})
    assert read_task(tmp_path, "b").right == right


def test_a_truth_that_accepts_none_asks_for_no_name(tmp_path: Path) -> None:
    truth = {"effect": "none", "accepted": ["none"], "noise_percent": 0.1, "noise_u": 0.002}
    pump_set(tmp_path, "b", (WITHHELD, "fit.txt"), truth)
    assert read_task(tmp_path, "b").right == Right(())


def test_a_set_without_the_wave_is_refused(tmp_path: Path) -> None:
    pump_set(tmp_path, "b", ("fit.txt",), {"effect": "none"})
    with pytest.raises(BadInput, match="to withhold"):
        read_task(tmp_path, "b")


def mass_task() -> Task:
    rng, time, records = np.random.default_rng(2), np.arange(1001) / 100, []
    for use, start in (("fit", (0.0, 0.0)), ("test", (0.06, 0.5))):
        pushed = force(time, seed=4)
        states = motion(time, pushed, start) + 1e-3 * rng.standard_normal((time.size, 2))
        records.append(logged(use, time, pushed, states, ("x",), use))
    data: Dataset = measured("mass", tuple(records), {"x": 1e-3})
    return Task("mass", data, Subject("Mass"), Right((("stiff",),)), {"x": 1e-3}, 1.0)


def test_errors_are_those_of_the_log_withheld_over_the_noise_and_a_rise_is_seen() -> None:
    task, model = mass_task(), mass_model()
    base, true = Step("refit", model, {**TRUTH, "c": 1.1 * TRUTH["c"]}), Step("stiff", model, TRUTH)
    good = judged(task, Answer(("stiff",), True, (base, true)))
    assert good.errors[0] > 3
    assert good.errors[1] == pytest.approx(1, rel=0.07)
    assert good.rise == pytest.approx(good.errors[1] / good.errors[0])
    assert good.wrong == ()
    worse = judged(replace(task, noise={}, right=None), Answer(("stiff",), True, (true, base)))
    assert worse.rise > RISE
    assert worse.wrong is None
    assert worse.errors[0] == pytest.approx(1e-3, rel=0.07)


def test_the_case_asks_for_every_set_of_the_folder_and_skips_the_others(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(ENVIRONMENT, str(tmp_path))
    pump_set(tmp_path, "m", (WITHHELD, "fit.txt"), {"effect": "x", "noise_percent": 0.1, "noise_u": 0.002})
    asked: list[bool] = []

    def ask(task: Task) -> Answer:
        asked.append(task.given.signal("u").noise is None)
        return Answer(("y",), True, ())

    found = list(run([("m", True), ("m", False), ("absent", True)], ask))
    assert asked == [False, True]
    assert [finding.holds for finding in found] == [False, True, False, True, False]
    assert [bool(finding.skipped) for finding in found] == [False, False, False, False, True]
