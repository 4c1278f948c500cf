"""Fitted transfer functions as text, as data for JSON and as a page."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from pysim.identify import magnitude_db
from pysim.identify.blackbox import FittedNumber, FittedResponse, OrderSuggestion, Root
from pysim.present import criteria
from pysim.present.notes import NOT_FITTED, words
from pysim.present.page import cell, heading, items, paragraph, pictures, table
from pysim.present.page import page as whole_page
from pysim.present.plain_text import with_interval, wrapped
from pysim.present.render import Drawing
from pysim.types import Deviation
from pysim.types.json_number import json_data

_WIDTH = 96
_SHOWN = 8  # structures listed


@dataclass(frozen=True)
class TransferFunctions:
    """Those fitted to the responses of one data set.

    Args:
        dataset: its name.
    """

    dataset: str
    fitted: tuple[FittedResponse, ...]


def text(result: TransferFunctions) -> str:
    """Every response: the structure, its numbers with their 95 percent intervals, poles and zeros, and what to know."""
    return "\n\n".join("\n".join(_text(one)) for one in result.fitted)


def _text(one: FittedResponse) -> Iterable[str]:
    fit = one.fit
    yield f"{one.label}: {fit.structure.label}{', stable on request' if fit.structure.stable else ''}"
    yield f"  fit {fit.fit_percent:.2f} %; {misfit(one)}"
    yield f"  {_deviations(one.deviations)}"
    yield from (f"  {NOT_FITTED}: {_deviations(deviations)}" for deviations in one.held_out)
    for e in numbers(one):
        value, low, high = with_interval(e.value, e.interval, 6)
        yield f"  {e.name:<10}{value:>14}  [{low}, {high}] {e.unit}".rstrip()
    for name, roots in (("pole", fit.poles), ("zero", fit.zeros)):
        yield from (f"  {name:<10}{root_text(root, fit.quantile(0.95))}" for root in upper(roots))
    if one.suggestion:
        yield from _suggestion_text(one.suggestion)
    for note in one.notes:
        yield from wrapped(f"note: {words(note)}", "  ", "    ", _WIDTH)


def _deviations(deviations: Sequence[Deviation]) -> str:
    texts = criteria.numbers([one.value for one in deviations])
    named = zip(deviations, texts, strict=True)
    return "; ".join(f"{one.criterion.name} {text} {one.criterion.unit}" for one, text in named)


def numbers(one: FittedResponse) -> tuple[FittedNumber, ...]:
    """Coefficients, dead time and gain."""
    return (*one.fit.estimates(), one.fit.gain())


def misfit(one: FittedResponse) -> str:
    """How far the fit is from the data, or how it was weighted where the noise is not known."""
    fit = one.fit
    if fit.noise_known:
        return f"misfit {fit.misfit:.1f} for {fit.freedom} degrees of freedom (probability {fit.explains:.2g})"
    return f"{fit.weights} weights, noise taken from the residuals"


def upper(roots: Sequence[Root]) -> list[Root]:
    """One of each conjugate pair."""
    return [root for root in roots if root.value.imag >= 0]


def root_text(root: Root, quantile: float) -> str:
    """A pole or zero with half its interval, `quantile` standard deviations."""
    value = root.value
    if value.imag == 0:
        return f"{value.real:.6g} ± {quantile * np.sqrt(root.covariance[0, 0]):.2g} rad/s"
    return (
        f"{root.frequency_hz:.5g} ± {quantile * root.frequency_deviation_hz:.2g} Hz, "
        f"damping {root.damping:.4g} ± {quantile * root.damping_deviation:.2g} (pair)"
    )


def _suggestion_text(suggestion: OrderSuggestion) -> Iterable[str]:
    yield "  structures by AICc (BIC)" + ("" if suggestion.noise_trusted else ", noise taken as unknown")
    lowest = suggestion.candidates[0].aicc
    lowest_bic = min(c.bic for c in suggestion.candidates)
    for c in suggestion.candidates[:_SHOWN]:
        mark = " <- suggested" if c is suggestion.suggested else "" if c.sound else "   (not sound)"
        yield f"    {c.fit.structure.label:<28}+{c.aicc - lowest:<8.1f}(+{c.bic - lowest_bic:.1f}){mark}"


def data(result: TransferFunctions) -> dict[str, Any]:
    """Everything as plain numbers; None where the data do not determine one. SI units; magnitudes absolute, in dB."""
    about = {"dataset": result.dataset, "level": 0.95}
    return json_data({**about, "responses": [_data(one) for one in result.fitted]})


def _data(one: FittedResponse) -> dict[str, Any]:
    fit, structure = one.fit, one.fit.structure
    return {
        **{key: getattr(one.measured.test, key) for key in ("input", "output", "offset", "amplitude")},
        "origin": one.measured.origin,
        "poles": structure.poles,
        "zeros": structure.zeros,
        "stable_on_request": structure.stable,
        "numerator": fit.function.numerator,
        "denominator": fit.function.denominator,
        "dead_time_s": fit.function.dead_time,
        "stable": fit.function.stable,
        "estimates": {
            e.name: {"value": e.value, "unit": e.unit, "std": e.std, "interval": e.interval} for e in numbers(one)
        },
        "covariance": {"names": fit.names, "matrix": fit.covariance},
        "pole_list": [_root(root) for root in fit.poles],
        "zero_list": [_root(root) for root in fit.zeros],
        "fit_percent": fit.fit_percent,
        "weights": fit.weights,
        "misfit": fit.misfit,
        "degrees_of_freedom": fit.freedom,
        "probability": fit.explains,
        "deviations": criteria.keyed(one.deviations),
        "held_out_deviations": [criteria.keyed(deviations) for deviations in one.held_out],
        "converged": fit.converged,
        "notes": [words(note) for note in one.notes],
        "structures": None if one.suggestion is None else [_candidate(c) for c in one.suggestion.candidates],
        "frequency_hz": one.measured.frequency,
        "measured_db": magnitude_db(one.measured, None),
        "measured_deg": np.degrees(one.measured.phase),
        "residuals_standard_deviations": fit.standardised,
    }


def _candidate(candidate: Any) -> dict[str, Any]:
    structure = candidate.fit.structure
    return {
        "poles": structure.poles,
        "zeros": structure.zeros,
        "dead_time": structure.delayed,
        "aicc": candidate.aicc,
        "bic": candidate.bic,
        "sound": candidate.sound,
        "fit_percent": candidate.fit.fit_percent,
    }


def _root(root: Root) -> dict[str, Any]:
    return {
        "real": root.value.real,
        "imag": root.value.imag,
        "frequency_hz": root.frequency_hz,
        "damping": root.damping,
        "covariance": root.covariance,
    }


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
    rows = [[e.name, *with_interval(e.value, e.interval, 6), e.unit] for e in numbers(one)]
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
