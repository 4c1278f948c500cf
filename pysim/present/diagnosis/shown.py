"""A diagnosis, or one of its steps, as a command shows it."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from pysim.present.diagnosis.answer import diagnosis_data, diagnosis_text
from pysim.present.diagnosis.figures import pictures
from pysim.present.diagnosis.page import diagnosis_page
from pysim.present.render import Drawing, Picture
from pysim.types import Dataset, Diagnosis


@dataclass(frozen=True)
class Diagnosed:
    """What was found, and what leads the page.

    Args:
        dataset: of which the records are; None where only the answer is at hand.
        title: model and data, for the line below the heading.
        question: the heading.
        answer: a sentence or two; the verdict where empty.
        files: what lies beside the page, name -> path relative to it, or to the JSON file once all is placed.
    """

    found: Diagnosis
    dataset: Dataset | None = None
    title: str = ""
    question: str = "Which effect is missing?"
    answer: str = ""
    files: Mapping[str, str] = field(default_factory=dict)


def whole(result: Diagnosis | Diagnosed) -> Diagnosed:
    """An answer with its question."""
    if isinstance(result, Diagnosed):
        return result
    names = [result.conditions[key] for key in ("model", "data set") if key in result.conditions]
    return Diagnosed(result, title=", ".join(names))


def text(result: Diagnosed) -> str:
    """The answer, then the evidence."""
    return diagnosis_text(result.found, result.answer)


def data(result: Diagnosed) -> dict[str, object]:
    """Every number finite or None."""
    return diagnosis_data(result.found, result.files)


def figures(result: Diagnosed) -> Iterator[Picture]:
    """The error, records, learned laws, candidates and parameters, as far as there are any."""
    return pictures(result.found, result.dataset)


def files(result: Diagnosed) -> dict[str, str]:
    """The plan of the next test, where there is one."""
    plan = result.found.next_test.plan if result.found.next_test is not None else ""
    return {"next_test.toml": plan} if plan else {}


def page(result: Diagnosed, drawings: Sequence[Drawing], redo: str) -> str:
    """The verdict and the falling error first, then the evidence."""
    drawn: dict[str, dict[str, bytes]] = {}
    for one in drawings:
        drawn.setdefault(one.section, {})[one.caption] = one.svg
    plan = next(iter(files(result)), "")
    return diagnosis_page(
        result.found,
        title=result.title,
        pictures=drawn,
        redo=redo,
        files={**result.files, **({"plan": plan} if plan else {})},
        question=result.question,
        answer=result.answer,
    )


def placed(result: Diagnosed, written: Mapping[str, Path], home: Path) -> Diagnosed:
    """The same with all files of its report, relative to another folder.

    Args:
        written: of the report, as `write_report` gives them.
        home: the folder of the JSON file.
    """
    folder = written["report"].parent
    paths = {"report": written["report"], **{name: folder / one for name, one in result.files.items()}}
    for name in files(result):
        paths["plan"] = folder / name
    paths |= {f"picture {name}": path for name, path in written.items() if path.suffix == ".png"}
    return replace(result, files=relative_files(paths, home))


def relative_files(files: Mapping[str, Path], folder: Path) -> dict[str, str]:
    """Paths relative to a folder, with slashes."""
    return {name: Path(os.path.relpath(path.resolve(), folder.resolve())).as_posix() for name, path in files.items()}
