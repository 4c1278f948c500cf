"""The pictures of a diagnosis."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from pysim.present.diagnosis.answer import Diagnosed
from pysim.present.diagnosis.figures.candidates import candidates_figure
from pysim.present.diagnosis.figures.error import error_figure
from pysim.present.diagnosis.figures.law import law_figure
from pysim.present.diagnosis.figures.parameters import parameters_figure
from pysim.present.diagnosis.figures.records import overlay_figure, telling_records
from pysim.present.diagnosis.figures.spectrum import spectrum_figure
from pysim.present.diagnosis.figures.where import map_figure
from pysim.present.notes import USES
from pysim.present.render import Picture
from pysim.types import Dataset, Diagnosis, LearnedLaw
from pysim.types.answer import REFIT

__all__ = [
    "candidates_figure",
    "error_figure",
    "figures",
    "law_figure",
    "map_figure",
    "overlay_figure",
    "parameters_figure",
    "spectrum_figure",
    "telling_records",
]

_PLACES = 3  # whose law is drawn


def figures(result: Diagnosed) -> Iterator[Picture]:
    """Those for which there is something to show, each with the section of the page it stands in."""
    found, dataset = result.found, result.dataset
    if found.history:
        below = "; below, the worst value of each criterion of thesis Tables 1.3 and 1.4" * bool(
            found.history[-1].criteria
        )
        caption = f"The error, step by step: root-mean-square residual over noise{below}."
        yield Picture("error", caption, error_figure(found.history), "error")
    for k, law in enumerate(found.laws[:_PLACES]):
        if law.knots.size > 1:
            caption = (
                f"What the model lacks at {law.slot}, over {law.argument}, with its 95 percent band: it explains "
                f"{100 * law.share:.1f} % of the misfit."
            )
            yield Picture(f"law_{k + 1}", caption, law_figure(law, samples_of(found, law)), "learned")
    yield from _record_figures(found, dataset)
    if found.rivals:
        caption = "Candidates by what each explains of the misfit."
        yield Picture("candidates", caption, candidates_figure(found), "candidates")
    base = found.base
    if base is not None and base.step == REFIT and base.estimates:
        caption = "Parameters between their bounds, and by how much they moved once what was missing was in the model."
        caption = caption if found.last else "The refitted parameters between their bounds."
        yield Picture("parameters", caption, parameters_figure(base, found.last), "parameters")


def samples_of(found: Diagnosis, law: LearnedLaw) -> NDArray[np.float64] | None:
    """Of the law's argument, where it was logged."""
    records = found.history[-1].records if found.history else ()
    own = [r.measured[law.argument] for r in records if law.argument in r.measured.names]
    return np.concatenate([values[np.isfinite(values)] for values in own]) if own else None


def _record_figures(found: Diagnosis, dataset: Dataset | None) -> Iterator[Picture]:
    model = "refitted model" if found.base is not None and found.base.step == REFIT else "model as it is"
    for k, record in enumerate(telling_records(found)):
        caption = (
            f"{record.source} ({USES[record.use]}), where the {model} fails most: measured and simulated; "
            "below, the residual (of many samples also running means), grey holds 95 percent of noise."
        )
        yield Picture(f"record_{k + 1}", caption, overlay_figure(found, record), "records")
    logs = [record for step in found.history for record in step.records]
    if logs:
        caption = "Residual of every test, in standard deviations of the noise."
        yield Picture("map", caption, map_figure(found, dataset), "where")
    if any(not record.harmonics and record.residual.time.size >= 128 for record in logs):
        caption = "Residual by frequency: white noise of the stated size is 1, grey holds 95 percent of it."
        yield Picture("spectrum", caption, spectrum_figure(found), "where")
