"""Fitted transfer functions as text and as data."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from pysim.identify import magnitude_db
from pysim.identify.blackbox import FittedNumber, FittedResponse, OrderSuggestion, Root
from pysim.io import json_number
from pysim.present.notes import words
from pysim.types import Deviation

_WIDTH = 96
DIGITS = (2, 2, 1, 1)
_SHOWN = 8  # structures listed
_CRITERIA_KEYS = ("mean_magnitude_db", "max_magnitude_db", "mean_phase_deg", "max_phase_deg")


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
    yield from (f"  held out: {_deviations(deviations)}" for deviations in one.held_out)
    for e in numbers(one):
        yield f"  {e.name:<10}{e.value:>14.6g}  [{e.interval[0]:.6g}, {e.interval[1]:.6g}] {e.unit}".rstrip()
    for name, roots in (("pole", fit.poles), ("zero", fit.zeros)):
        yield from (f"  {name:<10}{root_text(root, fit.quantile(0.95))}" for root in upper(roots))
    if one.suggestion:
        yield from _suggestion_text(one.suggestion)
    for note in one.notes:
        yield textwrap.fill(f"note: {words(note)}", _WIDTH, initial_indent="  ", subsequent_indent="    ")


def _deviations(deviations: Sequence[Deviation]) -> str:
    return "; ".join(
        f"{d.criterion.name} {d.value:.{n}f} {d.criterion.unit}" for d, n in zip(deviations, DIGITS, strict=True)
    )


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
    return {"dataset": result.dataset, "level": 0.95, "responses": [_data(one) for one in result.fitted]}


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
        "estimates": {e.name: _estimate(e) for e in numbers(one)},
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
        "notes": [words(note) for note in one.notes],
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
