"""Fitted transfer functions as text and as data."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from pysim.identify import magnitude_db
from pysim.identify.blackbox import FittedNumber, FittedResponse, OrderSuggestion, Root
from pysim.present import criteria
from pysim.present.notes import NOT_FITTED, words
from pysim.present.plain_text import wrapped
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
        yield f"  {e.name:<10}{e.value:>14.6g}  [{e.interval[0]:.6g}, {e.interval[1]:.6g}] {e.unit}".rstrip()
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
