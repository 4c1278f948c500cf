"""A fit as text for a terminal, as data for JSON, as files and as a page."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from pysim.identify.greybox import Profile, fit_warnings
from pysim.io import shown_value, toml_key, toml_table
from pysim.present.notes import USES, direction_words, estimate_words, sentences, words
from pysim.present.page import cell, heading, items, paragraph, pictures, table
from pysim.present.page import page as whole_page
from pysim.present.plain_text import with_interval, wrapped
from pysim.present.render import Drawing
from pysim.types import Dataset, Estimate, Fit, FitOutcome, RecordFit, ResponseFit
from pysim.types.json_number import json_data


@dataclass(frozen=True)
class Fitted:
    """A fit with what it was fitted to.

    Args:
        profiles: exact intervals, of the parameters that were asked for.
    """

    fit: Fit
    datasets: tuple[Dataset, ...]
    profiles: tuple[Profile, ...] = ()


def whole(result: Fit | Fitted) -> Fitted:
    """A fit alone, without profiles and without its data sets, whose inputs' units are then not known."""
    return result if isinstance(result, Fitted) else Fitted(result, ())


def text(result: Fitted) -> str:
    """Estimates, what is not determined, what every record leaves over, and profiles."""
    fit = result.fit
    lines = [f"{fit.model}: {fit.objective}; {fit.optimiser}, {fit.iterations} points tried, {outcome_text(fit)}"]
    lines.append(f"residual over noise {fit.misfit:.4g} (1 is perfect); {gain_text(fit)}")
    lines.append(f"  {'parameter':<14}{'estimate':>12}  {'95 % from':>11} {'to':>11}  unit")
    lines += [_row(estimate) for estimate in (*fit.estimates, *fit.initial)]
    for c in fit.combinations:
        value, low, high = with_interval(c.value, c.interval)
        lines.append(f"  {c.name} = {value}, 95 % {low} to {high}")
    lines += [f"  {text}" for text in _left_over(fit)]
    warnings = fit_warnings(fit)
    others = [note for note in fit.notes if note not in warnings]
    for kind, texts in (("Warning", sentences(warnings)), ("Note", sentences(others))):
        lines += [line for text in texts for line in wrapped(f"{kind}: {text}")]
    for p in result.profiles:
        lines.append("Profile of {}: 95 % from {} to {}".format(p.name, *with_interval(0.0, p.interval)[1:]))
    return "\n".join(lines)


def outcome_text(fit: Fit) -> str:
    """How the search ended, and why."""
    return f"{fit.outcome.value} ({fit.message})" if fit.message else fit.outcome.value


def gain_text(fit: Fit) -> str:
    """What the search gained on the start; half a sum of squares, where the objective is one."""
    return f"the search lowered the cost by {fit.start_cost - fit.cost:.4g}"


def _row(estimate: Estimate) -> str:
    value, low, high = with_interval(estimate.value, estimate.interval)
    row = f"  {estimate.name:<14}{value:>12}  {low:>11} {high:>11}  {estimate.unit:<7}"
    return f"{row}{estimate_words(estimate)}".rstrip()


def _left_over(fit: Fit) -> list[str]:
    """Root-mean-square residual over noise: single logs, and the stepped sines of a data set together."""
    lines = []
    sines: dict[tuple[str, str, str], list[float]] = {}
    for record in fit.records:
        for name, value in record.rms.items():
            if record.harmonics:
                sines.setdefault((record.dataset, USES[record.use], name), []).append(value)
            else:
                lines.append(f"{record.source} ({USES[record.use]}), {name}: residual {value:.3f} of the noise")
    for (dataset, use, name), values in sines.items():
        together = math.sqrt(sum(v * v for v in values) / len(values))
        lines.append(f"{len(values)} stepped sines of {dataset} ({use}), {name}: residual {together:.3f} of the noise")
    return lines


def files(result: Fitted) -> dict[str, str]:
    """The fitted values, as `--parameters` takes them."""
    values = {toml_key(name): float(value) for name, value in result.fit.values.items() if "@" not in name}
    return {"parameters.toml": toml_table(f"# Of {result.fit.model}, fitted.", values)}


def data(result: Fitted) -> dict[str, Any]:
    """Everything a fit holds but the samples; numbers are finite or None, parameters in the variables' units."""
    profiles = {p.name: {"interval": p.interval, "points": p.points} for p in result.profiles}
    return json_data({**_data(result.fit), "profiles": profiles})


_ESTIMATE = ("value", "unit", "start", "lower", "upper", "std", "interval", "determined")


def _keys(of: object, *names: str) -> dict[str, Any]:
    return {name: getattr(of, name) for name in names}


def _data(fit: Fit) -> dict[str, Any]:
    return {
        **_keys(fit, "model", "objective", "optimiser", "message", "iterations", "cost", "start_cost", "misfit"),
        **_keys(fit, "values", "covariance", "correlation"),
        "outcome": fit.outcome.name.lower(),
        "converged": fit.outcome is FitOutcome.CONVERGED,
        "estimates": {e.name: {**_keys(e, *_ESTIMATE), "at_bound": e.at} for e in fit.estimates},
        "initial_states": {e.name: _keys(e, "value", "unit", "std", "interval", "determined") for e in fit.initial},
        "undetermined": [{**_keys(d, "exponents", "spread"), "words": direction_words(d)} for d in fit.undetermined],
        "combinations": [_keys(c, "name", "exponents", "value", "interval") for c in fit.combinations],
        "records": [_record(record) for record in fit.records],
        "responses": [_response(response) for response in fit.responses],
        "starts": [_keys(s, "name", "values", "first_cost", "cost") for s in fit.starts],
        "warnings": [words(note) for note in fit_warnings(fit)],
        "warning_codes": [note.code.value for note in fit_warnings(fit)],
        "notes": [words(note) for note in fit.notes],
        "note_codes": [note.code.value for note in fit.notes],
    }


def _record(record: RecordFit) -> dict[str, Any]:
    return {
        **_keys(record, "dataset", "source", "kind", "use"),
        "samples": {name: int(np.isfinite(record.measured[name]).sum()) for name in record.measured.names},
        "rms_over_noise": record.rms,
        "criteria": {
            name: {d.criterion.symbol: {"value": d.value, "limit": d.criterion.limit} for d in deviations}
            for name, deviations in record.deviations.items()
        },
    }


def _response(response: ResponseFit) -> dict[str, Any]:
    return {
        **_keys(response, "dataset", "use"),
        **_keys(response.comparison.measured.test, "offset", "amplitude", "output"),
        "criteria": {d.criterion.symbol: float(d.value) for d in response.comparison.deviations},
        "passes": response.comparison.passes,
    }


def page(result: Fitted, drawings: Sequence[Drawing], redo: str) -> str:
    """Outcome, estimates, what is not determined, records, responses, pictures."""
    fit = result.fit
    units = {signal.name: signal.unit for one in result.datasets for signal in one.signals if signal.role == "input"}
    verdict = [
        f"The search {outcome_text(fit)} after {fit.iterations} points.",
        f"Root-mean-square residual over the noise: {fit.misfit:.3f} (1: nothing but noise is left).",
        f"{gain_text(fit).capitalize()}.",
    ]
    warnings = fit_warnings(fit)
    notes = sentences([note for note in fit.notes if note not in warnings])
    parts = [heading("Outcome"), items([*verdict, *notes])]
    parts += [heading("When not to trust it"), items(sentences(warnings))] if warnings else []
    parts += [heading("Parameters"), _estimates_table(fit.estimates, "Estimates with 95 percent intervals")]
    parts += (
        [_estimates_table(fit.initial, "States at the first sample of a log, estimated from it")] if fit.initial else []
    )
    parts += [_combinations_table(fit)] if fit.combinations else []
    parts += [heading("What each record leaves over"), _records_table(fit)]
    parts += [_responses_table(fit, units)] if fit.responses else []
    parts += [heading("Pictures"), *pictures(drawings)]
    parts.append(paragraph(_METHOD))
    lead = f"{fit.model}; {fit.objective}; {fit.optimiser}."
    return whole_page("A model fitted to its measurements", lead, parts, redo)


_METHOD = (
    "Intervals are to first order around the estimates, widened by the residual where the model does not fit to the "
    "noise; at a bound they are one-sided. Only records marked fitted had a part in the fit."
)


def _estimates_table(estimates: Sequence[Estimate], caption: str) -> str:
    rows = []
    for e in estimates:
        others = [f"{v:.5g}" for v in (e.start, e.lower, e.upper)]
        rows.append([e.name, e.unit, *with_interval(e.value, e.interval), *others, estimate_words(e)])
    head = ["parameter", "unit", "estimate", "95 % from", "to", "start", "lower", "upper", ""]
    return table(caption, head, rows, words=[8])


def _combinations_table(fit: Fit) -> str:
    rows = [[c.name, *with_interval(c.value, c.interval)] for c in fit.combinations]
    caption = "Combinations that are determined (product of the parameters' units)"
    return table(caption, ["", "value", "95 % from", "to"], rows)


def _records_table(fit: Fit) -> str:
    rows = []
    for record in fit.records:
        for name, value in record.rms.items():
            errors = [f"{d.criterion.symbol} {d.value:.2f} {d.criterion.unit}" for d in record.deviations.get(name, ())]
            size = cell(f"{value:.3f}", "beyond" * (value > 1.5))
            rows.append([record.dataset, record.source, USES[record.use], name, size, "; ".join(errors)])
    head = ["data set", "record", "use", "signal", "residual / noise", "errors of thesis Table 1.4"]
    return table("Root-mean-square residual over the noise", head, rows, words=range(4))


def _responses_table(fit: Fit, units: Mapping[str, str]) -> str:
    rows, head = [], ["data set", "use", "offset", "amplitude", "signal"]
    kinds = set(units.values())
    only = kinds.pop() if len(kinds) == 1 else "1"  # stepped sines do not tell which input swung
    for response in fit.responses:
        test, deviations = response.comparison.measured.test, response.comparison.deviations
        unit = units.get(test.input, only)
        offset, amplitude = (shown_value(value, unit) for value in (test.offset, test.amplitude))
        texts = (response.dataset, USES[response.use], offset, amplitude, test.output)
        verdict = "pass" if response.comparison.passes else "fail"
        numbers = [cell(f"{d.value:.2f}", "" if d.passes else "beyond") for d in deviations]
        rows.append([*texts, *numbers, cell(verdict, verdict)])
        names = [f"{d.criterion.symbol} ({d.criterion.unit}, limit {d.criterion.limit:g})" for d in deviations]
    return table("Frequency responses by thesis Table 1.3", [*head, *names, ""], rows)
