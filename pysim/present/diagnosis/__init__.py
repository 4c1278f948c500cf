"""A diagnosis, shown: its words, its answer as text and JSON, its page and its pictures."""

from pysim.present.diagnosis.answer import diagnosis_data, diagnosis_text, evidence_text
from pysim.present.diagnosis.figures import (
    diagnosis_failures_figure,
    diagnosis_ledger_figure,
    diagnosis_map_figure,
    diagnosis_overlay_figure,
    diagnosis_parameters_figure,
    diagnosis_ranking_figure,
    diagnosis_spectrum_figure,
    missing_figure,
    telling_records,
)
from pysim.present.diagnosis.shown import Diagnosed, data, figures, files, page, placed, relative_files, text

__all__ = [
    "Diagnosed",
    "data",
    "diagnosis_data",
    "diagnosis_failures_figure",
    "diagnosis_ledger_figure",
    "diagnosis_map_figure",
    "diagnosis_overlay_figure",
    "diagnosis_parameters_figure",
    "diagnosis_ranking_figure",
    "diagnosis_spectrum_figure",
    "diagnosis_text",
    "evidence_text",
    "figures",
    "files",
    "missing_figure",
    "page",
    "placed",
    "relative_files",
    "telling_records",
    "text",
]
