"""The pictures of a diagnosis."""

from __future__ import annotations

from collections.abc import Iterator

from pysim.present.diagnosis.figures.error import diagnosis_ledger_figure, diagnosis_ranking_figure
from pysim.present.diagnosis.figures.missing import missing_figure
from pysim.present.diagnosis.figures.parameters import diagnosis_parameters_figure
from pysim.present.diagnosis.figures.records import diagnosis_overlay_figure, telling_records
from pysim.present.diagnosis.figures.spectrum import diagnosis_spectrum_figure
from pysim.present.diagnosis.figures.where import diagnosis_failures_figure, diagnosis_map_figure
from pysim.present.render import Picture
from pysim.types import Dataset, Diagnosis

__all__ = [
    "diagnosis_failures_figure",
    "diagnosis_ledger_figure",
    "diagnosis_map_figure",
    "diagnosis_overlay_figure",
    "diagnosis_parameters_figure",
    "diagnosis_ranking_figure",
    "diagnosis_spectrum_figure",
    "missing_figure",
    "pictures",
    "telling_records",
]

_PLACES = 3  # whose missing term is drawn


def pictures(found: Diagnosis, dataset: Dataset) -> Iterator[Picture]:
    """Those for which there is something to show, each with the section of the page it stands in."""
    if found.error:
        caption = (
            "The error, step by step: root-mean-square residual over noise; below, the worst value of each criterion "
            "of thesis Tables 1.3 and 1.4."
        )
        yield Picture("ledger", caption, diagnosis_ledger_figure(found.error), "ledger")
    yield from _record_figures(found, dataset)
    yield from _missing_figures(found)
    if found.ranking:
        caption = "Candidates by their gain less the penalty for their parameters; n is the number of residuals."
        yield Picture("ranking", caption, diagnosis_ranking_figure(found), "ranking")
    base = next((stage for stage in found.stages if stage.step == "refit"), None)
    if base is not None and base.estimates:
        last = found.stages[-1] if found.added else None
        caption = "Parameters between their bounds, and by how much they moved once what was missing was in the model."
        caption = caption if last else "The refitted parameters between their bounds."
        yield Picture("parameters", caption, diagnosis_parameters_figure(base, last), "parameters")


def _missing_figures(found: Diagnosis) -> Iterator[Picture]:
    for k, one in enumerate(found.missing[:_PLACES]):
        if one.shape.argument.size > 1:
            caption = (
                f"What the model would need at {one.slot}, over {one.depends_on}, with its 95 percent band: "
                f"{100 * one.share:.1f} % of the misfit."
            )
            yield Picture(f"missing_{k + 1}", caption, missing_figure(one), "missing")


def _record_figures(found: Diagnosis, dataset: Dataset) -> Iterator[Picture]:
    model = "refitted model" if any(stage.step == "refit" for stage in found.stages) else "model as it is"
    for k, record in enumerate(telling_records(found)):
        use = "held out" if record.use == "validate" else "fitted"
        caption = (
            f"{record.source} ({use}), where the {model} fails most: measured and simulated; "
            "below, what is left (of many samples also running means), grey holds 95 percent of noise."
        )
        yield Picture(f"record_{k + 1}", caption, diagnosis_overlay_figure(found, record), "records")
    logs = [record for stage in found.stages for record in stage.records]
    if found.where:
        caption = f"The places where the {model} fails most."
        yield Picture("where", caption, diagnosis_failures_figure(found), "where")
    if logs:
        caption = "What is left over of every test, in units of noise."
        yield Picture("map", caption, diagnosis_map_figure(found, dataset), "where")
    if any(not record.harmonics and record.residual.time.size >= 128 for record in logs):
        caption = "What is left over by frequency: white noise of the stated size is 1, grey holds 95 percent of it."
        yield Picture("spectrum", caption, diagnosis_spectrum_figure(found), "where")
