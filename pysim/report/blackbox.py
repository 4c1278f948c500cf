"""Fitted transfer functions as text, as data and as a section of the HTML page."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from pysim.identify import FREQUENCY_CRITERIA, magnitude_db
from pysim.identify.blackbox import FittedNumber, FittedResponse, OrderSuggestion, Root
from pysim.io import json_number
from pysim.present.page import cell, commands, heading, items, page, paragraph, picture, table
from pysim.types import Deviation

_WIDTH = 96
_DIGITS = (2, 2, 1, 1)
_SHOWN = 8  # structures listed
_CRITERIA_KEYS = ("mean_magnitude_db", "max_magnitude_db", "mean_phase_deg", "max_phase_deg")


def blackbox_text(fitted: Sequence[FittedResponse]) -> str:
    """Every response: the structure, its numbers with their 95 percent intervals, poles and zeros, and what to know."""
    return "\n\n".join("\n".join(_text(one)) for one in fitted)


def _text(one: FittedResponse) -> Iterable[str]:
    fit = one.fit
    yield f"{one.label}: {fit.structure.label}{', stable on request' if fit.structure.stable else ''}"
    yield f"  fit {fit.fit_percent:.2f} %; {_misfit(one)}"
    yield f"  {_deviations(one.deviations)}"
    yield from (f"  held out: {_deviations(deviations)}" for deviations in one.held_out)
    for e in _numbers(one):
        yield f"  {e.name:<10}{e.value:>14.6g}  [{e.interval[0]:.6g}, {e.interval[1]:.6g}] {e.unit}".rstrip()
    for name, roots in (("pole", fit.poles), ("zero", fit.zeros)):
        yield from (f"  {name:<10}{_root_text(root, fit.quantile(0.95))}" for root in _upper(roots))
    if one.suggestion:
        yield from _suggestion_text(one.suggestion)
    for note in (*fit.notes, *one.remarks):
        yield textwrap.fill(f"note: {note}", _WIDTH, initial_indent="  ", subsequent_indent="    ")


def _deviations(deviations: Sequence[Deviation]) -> str:
    return "; ".join(
        f"{d.criterion.name} {d.value:.{n}f} {d.criterion.unit}" for d, n in zip(deviations, _DIGITS, strict=True)
    )


def _numbers(one: FittedResponse) -> tuple[FittedNumber, ...]:
    return (*one.fit.estimates(), one.fit.gain())


def _misfit(one: FittedResponse) -> str:
    fit = one.fit
    if fit.noise_known:
        return f"misfit {fit.misfit:.1f} for {fit.freedom} degrees of freedom (probability {fit.explains:.2g})"
    return f"{fit.weights} weights, noise taken from the residuals"


def _upper(roots: Sequence[Root]) -> list[Root]:
    """One of each conjugate pair."""
    return [root for root in roots if root.value.imag >= 0]


def _root_text(root: Root, quantile: float) -> str:
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


def blackbox_data(fitted: Sequence[FittedResponse], *, dataset: str) -> dict[str, Any]:
    """Everything as plain numbers; None where the data do not determine one. SI units; magnitudes absolute, in dB."""
    return {"dataset": dataset, "level": 0.95, "responses": [_data(one) for one in fitted]}


def _data(one: FittedResponse) -> dict[str, Any]:
    fit, structure = one.fit, one.fit.structure
    return {
        "input": one.measured.test.input,
        "output": one.measured.test.output,
        "origin": one.measured.origin,
        "offset": one.measured.test.offset,
        "amplitude": one.measured.test.amplitude,
        "poles": structure.poles,
        "zeros": structure.zeros,
        "stable_on_request": structure.stable,
        "numerator": list(fit.function.numerator),
        "denominator": list(fit.function.denominator),
        "dead_time_s": fit.function.dead_time,
        "stable": fit.function.stable,
        "estimates": {e.name: _estimate(e) for e in _numbers(one)},
        "covariance": {"names": list(fit.names), "matrix": [[json_number(v) for v in row] for row in fit.covariance]},
        "pole_list": [_root(root) for root in fit.poles],
        "zero_list": [_root(root) for root in fit.zeros],
        "fit_percent": json_number(fit.fit_percent),
        "weights": fit.weights,
        "misfit": fit.misfit,
        "degrees_of_freedom": fit.freedom,
        "probability": json_number(fit.explains),
        "deviations": _criteria(one.deviations),
        "held_out_deviations": [_criteria(deviations) for deviations in one.held_out],
        "converged": fit.converged,
        "notes": [*fit.notes, *one.remarks],
        "structures": None if one.suggestion is None else [_candidate(c) for c in one.suggestion.candidates],
        "frequency_hz": one.measured.frequency.tolist(),
        "measured_db": magnitude_db(one.measured, None).tolist(),
        "measured_deg": np.degrees(one.measured.phase).tolist(),
        "residuals_standard_deviations": fit.standardised.tolist(),
    }


def _criteria(deviations: Sequence[Deviation]) -> dict[str, float]:
    return {key: float(d.value) for key, d in zip(_CRITERIA_KEYS, deviations, strict=True)}


def _candidate(candidate: Any) -> dict[str, Any]:
    structure = candidate.fit.structure
    return {
        "poles": structure.poles,
        "zeros": structure.zeros,
        "dead_time": structure.delayed,
        "aicc": candidate.aicc,
        "bic": candidate.bic,
        "sound": candidate.sound,
        "fit_percent": json_number(candidate.fit.fit_percent),
    }


def _estimate(e: FittedNumber) -> dict[str, Any]:
    return {
        "value": json_number(e.value),
        "unit": e.unit,
        "std": json_number(e.std),
        "interval": [json_number(end) for end in e.interval],
    }


def _root(root: Root) -> dict[str, Any]:
    return {
        "real": root.value.real,
        "imag": root.value.imag,
        "frequency_hz": root.frequency_hz,
        "damping": root.damping,
        "covariance": [[json_number(v) for v in row] for row in root.covariance],
    }


def blackbox_page(dataset: str, fitted: Sequence[FittedResponse], *, pictures: Sequence[bytes], redo: str) -> str:
    """A self-contained HTML page; pictures (SVG) are one per response, or none."""
    parts = [*blackbox_section(fitted, pictures=pictures), heading("Do it again"), commands(redo)]
    return page("Black-box transfer functions", f"Fitted to the frequency responses of {dataset}.", parts)


def blackbox_section(fitted: Sequence[FittedResponse], *, pictures: Sequence[bytes]) -> list[str]:
    """Parts of a page: what was done, a row per response, the numbers of each and its picture, where there are any."""
    parts = [heading("Transfer functions"), items(_method()), _overview(fitted)]
    for i, one in enumerate(fitted):
        parts += [heading(f"{one.label}: {one.fit.structure.label}"), _numbers_table(one), _roots_table(one)]
        if one.suggestion:
            parts.append(_structures_table(one.suggestion))
        parts += [paragraph(note, note=True) for note in (*one.fit.notes, *one.remarks)]
        if pictures:
            caption = f"{one.label}: gain, phase and residuals of the fit; its poles and zeros."
            parts.append(picture(pictures[i], caption))
    return parts


def _method() -> list[str]:
    return [
        "A rational transfer function with the stated numbers of poles and zeros, and a dead time where asked for, was "
        "fitted to the complex gains by weighted least squares, real and imaginary part jointly (thesis Section 2.4).",
        "Fit: 100 (1 - |measured - fitted| / |measured - mean|) percent over the complex gains, the measure MATLAB "
        "quotes. Deviations: as in thesis Table 4.4, to be held against Table 1.3.",
        "Intervals are at 95 percent, to first order in the noise. They speak of random deviations: a structure that "
        "cannot hold the response has a systematic error besides.",
    ]


def _overview(fitted: Sequence[FittedResponse]) -> str:
    head = ["test", "structure", "fit (%)", "gain"]
    head += [f"{c.name.replace(' deviation', '')} ({c.unit})" for c in FREQUENCY_CRITERIA]
    rows = []
    for one in fitted:
        row = [one.label, one.fit.structure.label, f"{one.fit.fit_percent:.2f}", f"{one.fit.gain().value:.4g}"]
        rows.append([*(cell(text) for text in row), *_marked(one.deviations)])
        rows += [[cell(one.label), cell("held out"), cell(""), cell(""), *_marked(other)] for other in one.held_out]
    return table("Every response; marked: beyond the limits of thesis Table 1.3", head, rows)


def _marked(deviations: Sequence[Deviation]) -> list[str]:
    return [cell(f"{d.value:.{n}f}", "" if d.passes else "beyond") for d, n in zip(deviations, _DIGITS, strict=True)]


def _numbers_table(one: FittedResponse) -> str:
    rows = [
        [cell(e.name), cell(f"{e.value:.6g}"), *(cell(f"{end:.6g}") for end in e.interval), cell(e.unit)]
        for e in _numbers(one)
    ]
    caption = "Coefficients of powers of s (rad/s), denominator monic; gain at rest; 95 percent intervals"
    return table(caption, ["", "value", "low", "high", "unit"], rows)


def _roots_table(one: FittedResponse) -> str:
    rows = [
        [cell(name), cell(_root_text(root, one.fit.quantile(0.95)), "words")]
        for name, roots in (("pole", one.fit.poles), ("zero", one.fit.zeros))
        for root in _upper(roots)
    ]
    return table(f"Poles and zeros with 95 percent half widths; {_misfit(one)}", ["", ""], rows)


def _structures_table(suggestion: OrderSuggestion) -> str:
    lowest = suggestion.candidates[0].aicc
    lowest_bic = min(c.bic for c in suggestion.candidates)
    rows = [
        [
            cell(c.fit.structure.label, "differs" if c is suggestion.suggested else ""),
            cell(f"{c.aicc - lowest:.1f}"),
            cell(f"{c.bic - lowest_bic:.1f}"),
            cell(f"{c.fit.fit_percent:.2f}"),
            cell("" if c.sound else "; ".join(c.fit.notes) or "not sound", "words"),
        ]
        for c in suggestion.candidates
    ]
    head = ["structure", "AICc above lowest", "BIC above lowest", "fit (%)", "what speaks against it"]
    return table("Structures that were compared; bold: suggested", head, rows)
