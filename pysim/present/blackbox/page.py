"""Fitted transfer functions as a page."""

from __future__ import annotations

from collections.abc import Sequence

from pysim.identify.blackbox import FittedResponse, OrderSuggestion
from pysim.present import criteria
from pysim.present.blackbox.answer import TransferFunctions, misfit, numbers, root_text, upper
from pysim.present.notes import NOT_FITTED, words
from pysim.present.page import cell, heading, items, paragraph, pictures, table
from pysim.present.page import page as whole_page
from pysim.present.render import Drawing


def page(result: TransferFunctions, drawings: Sequence[Drawing], redo: str) -> str:
    """What was done, a row per response, the numbers of each and its picture, where there are any."""
    parts = [heading("Transfer functions"), items(_METHOD), _overview(result.fitted)]
    for i, one in enumerate(result.fitted):
        parts += [heading(f"{one.label}: {one.fit.structure.label}"), _numbers_table(one), _roots_table(one)]
        if one.suggestion:
            parts.append(_structures_table(one.suggestion))
        parts += [paragraph(words(note), note=True) for note in one.notes]
        parts += pictures(drawings[i : i + 1])
    lead = f"Fitted to the frequency responses of {result.dataset}."
    return whole_page("Black-box transfer functions", lead, parts, redo)


_METHOD = (
    "A rational transfer function with the stated numbers of poles and zeros, and a dead time where asked for, was "
    "fitted to the complex gains by weighted least squares, real and imaginary part jointly (thesis Section 2.4).",
    "Fit: 100 (1 - |measured - fitted| / |measured - mean|) percent over the complex gains, the measure MATLAB "
    "quotes. Deviations: as in thesis Table 4.4, to be held against Table 1.3.",
    "Intervals are at 95 percent, to first order in the noise. They speak of random deviations: a structure that "
    "cannot hold the response has a systematic error besides.",
)


def _overview(fitted: Sequence[FittedResponse]) -> str:
    head = ["test", "structure", "fit (%)", "gain", *criteria.heads()]
    rows = []
    for one in fitted:
        row = [one.label, one.fit.structure.label, f"{one.fit.fit_percent:.2f}", f"{one.fit.gain().value:.4g}"]
        rows.append([*row, *criteria.cells(one.deviations)])
        rows += [[one.label, NOT_FITTED, "", "", *criteria.cells(other)] for other in one.held_out]
    return table("Every response; marked: beyond the limits of thesis Table 1.3", head, rows)


def _numbers_table(one: FittedResponse) -> str:
    rows = [[e.name, *(f"{value:.6g}" for value in (e.value, *e.interval)), e.unit] for e in numbers(one)]
    caption = "Coefficients of powers of s (rad/s), denominator monic; gain at rest; 95 percent intervals"
    return table(caption, ["", "value", "low", "high", "unit"], rows)


def _roots_table(one: FittedResponse) -> str:
    rows = [
        [name, root_text(root, one.fit.quantile(0.95))]
        for name, roots in (("pole", one.fit.poles), ("zero", one.fit.zeros))
        for root in upper(roots)
    ]
    return table(f"Poles and zeros with 95 percent half widths; {misfit(one)}", ["", ""], rows, words=[1])


def _structures_table(suggestion: OrderSuggestion) -> str:
    lowest = suggestion.candidates[0].aicc
    lowest_bic = min(c.bic for c in suggestion.candidates)
    rows = [
        [
            cell(c.fit.structure.label, "differs" if c is suggestion.suggested else ""),
            f"{c.aicc - lowest:.1f}",
            f"{c.bic - lowest_bic:.1f}",
            f"{c.fit.fit_percent:.2f}",
            "" if c.sound else "; ".join(map(words, c.fit.notes)) or "not sound",
        ]
        for c in suggestion.candidates
    ]
    head = ["structure", "AICc above lowest", "BIC above lowest", "fit (%)", "what speaks against it"]
    return table("Structures that were compared; bold: suggested", head, rows, words=[4])
