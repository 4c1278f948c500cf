"""The report of a diagnosis and its pictures."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from pysim.cli._subject import Given
    from pysim.types import Dataset, Diagnosis


_PLACES = 3  # whose missing term is drawn


def write_diagnosis(
    found: Diagnosis, given: Given, folder: Path, redo: str, *, question: str, answer: str, place: Path | None = None
) -> dict[str, Path]:
    """Write the page, every picture as PNG and SVG, and the fitted model; name -> path.

    Args:
        place: where the folder's files will lie in the end; the folder itself by default.
        redo: the command line that makes it again.
        question, answer: what leads the page.
    """
    from pysim.cli._extended import relative_files, write_extended
    from pysim.io import write_file
    from pysim.report.diagnosis_page import diagnosis_page

    files = write_extended(found, given, folder, place=place)
    if found.next_test is not None and found.next_test.plan:
        files["plan"] = folder / "next_test.toml"
        write_file(files["plan"], found.next_test.plan)
    drawn, pictures = _drawn(found, given.dataset, folder)
    title = f"{given.model_name} against {given.dataset.name}"
    beside = relative_files(files, folder)
    text = diagnosis_page(
        found, title=title, pictures=pictures, redo=redo, files=beside, question=question, answer=answer
    )
    write_file(folder / "report.html", text)
    return {"report": folder / "report.html", **files, **drawn}


def _drawn(
    found: Diagnosis, dataset: Dataset, folder: Path
) -> tuple[dict[str, Path], Mapping[str, Mapping[str, bytes]]]:
    """Files written, and for each section of the page SVG by caption."""
    from pysim.io import write_file
    from pysim.plot import render

    files: dict[str, Path] = {}
    pictures: dict[str, dict[str, bytes]] = {}
    for section, name, caption, figure in _figures(found, dataset):
        files[f"picture {name}"] = folder / f"{name}.png"
        write_file(folder / f"{name}.png", render(figure, "png"))
        figure.set_layout_engine("none")  # found by the first drawing
        svg = render(figure, "svg")
        write_file(folder / f"{name}.svg", svg)
        pictures.setdefault(section, {})[caption] = svg
    return files, pictures


def _figures(found: Diagnosis, dataset: Dataset) -> Iterator[tuple[str, str, str, Figure]]:
    """Section of the page, file name, caption, figure; those for which there is something to show."""
    from pysim.plot import diagnosis_ledger_figure, diagnosis_parameters_figure, diagnosis_ranking_figure

    if found.error:
        caption = (
            "The error, step by step: root-mean-square residual over noise; below, the worst value of each criterion "
            "of thesis Tables 1.3 and 1.4."
        )
        yield "ledger", "ledger", caption, diagnosis_ledger_figure(found.error)
    yield from _record_figures(found, dataset)
    yield from _missing_figures(found)
    if found.ranking:
        caption = "Candidates by what they gain less their price; n is the number of residuals."
        yield "ranking", "ranking", caption, diagnosis_ranking_figure(found)
    base = next((stage for stage in found.stages if stage.step == "refit"), None)
    if base is not None and base.estimates:
        last = found.stages[-1] if found.added else None
        caption = "Parameters between their bounds, and by how much they moved once what was missing was in the model."
        caption = caption if last else "The refitted parameters between their bounds."
        yield "parameters", "parameters", caption, diagnosis_parameters_figure(base, last)


def _missing_figures(found: Diagnosis) -> Iterator[tuple[str, str, str, Figure]]:
    from pysim.plot import missing_figure

    for k, one in enumerate(found.missing[:_PLACES]):
        if one.shape.argument.size > 1:
            caption = (
                f"What the model would need at {one.slot}, over {one.depends_on}, with its 95 percent band: "
                f"{100 * one.share:.1f} % of the misfit."
            )
            yield "missing", f"missing_{k + 1}", caption, missing_figure(one)


def _record_figures(found: Diagnosis, dataset: Dataset) -> Iterator[tuple[str, str, str, Figure]]:
    from pysim.plot import (
        diagnosis_failures_figure,
        diagnosis_map_figure,
        diagnosis_overlay_figure,
        diagnosis_spectrum_figure,
        telling_records,
    )

    model = "refitted model" if any(stage.step == "refit" for stage in found.stages) else "model as it is"
    for k, record in enumerate(telling_records(found)):
        use = "held out" if record.use == "validate" else "fitted"
        caption = (
            f"{record.source} ({use}), where the {model} fails most: measured and simulated; "
            "below, what is left (of many samples also running means), grey holds 95 percent of noise."
        )
        yield "records", f"record_{k + 1}", caption, diagnosis_overlay_figure(found, record)
    logs = [record for stage in found.stages for record in stage.records]
    if found.where:
        caption = f"The places where the {model} fails most."
        yield "where", "where", caption, diagnosis_failures_figure(found)
    if logs:
        caption = "What is left over of every test, in units of noise."
        yield "where", "map", caption, diagnosis_map_figure(found, dataset)
    if any(not record.harmonics and record.residual.time.size >= 128 for record in logs):
        caption = "What is left over by frequency: white noise of the stated size is 1, grey holds 95 percent of it."
        yield "where", "spectrum", caption, diagnosis_spectrum_figure(found)
