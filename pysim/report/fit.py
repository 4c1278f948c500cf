"""A fit as text for a terminal, as data for JSON, and as a page."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Mapping, Sequence
from typing import Any

from pysim.io import json_number, shown_value
from pysim.present.page import cell, commands, heading, items, page, paragraph, picture, table
from pysim.types import Estimate, Fit, FitOutcome, RecordFit, ResponseFit

_WIDTH = 100


def fit_text(fit: Fit) -> str:
    """Estimates, what is not determined, and what every record leaves over."""
    lines = [f"{fit.model}: {fit.objective}; {fit.optimiser}, {fit.iterations} points tried, {outcome_text(fit)}"]
    lines.append(f"cost {fit.cost:.6g}, from {fit.start_cost:.6g}; residual over noise {fit.misfit:.4g}")
    lines.append(f"  {'parameter':<14}{'estimate':>12}  {'95 % from':>11} {'to':>11}  unit")
    lines += [_row(estimate) for estimate in fit.estimates]
    for direction in fit.undetermined:
        lines += textwrap.wrap(f"Not determined: {direction.words}", _WIDTH)
    lines += [f"  {c.name} = {c.value:.5g}, 95 % {c.interval[0]:.5g} to {c.interval[1]:.5g}" for c in fit.combinations]
    lines += [f"  {text}" for text in _left_over(fit)]
    for note in fit.notes:
        lines += textwrap.wrap(f"Note: {note}", _WIDTH)
    return "\n".join(lines)


def outcome_text(fit: Fit) -> str:
    """How the search ended, and why."""
    return f"{fit.outcome.value} ({fit.message})" if fit.message else fit.outcome.value


def _row(estimate: Estimate) -> str:
    low, high = estimate.interval
    told = f"at its {estimate.at} bound" if estimate.at else "" if estimate.determined else "not determined by itself"
    return (
        f"  {estimate.name:<14}{estimate.value:>12.5g}  {low:>11.5g} {high:>11.5g}  {estimate.unit:<7}{told}".rstrip()
    )


def _left_over(fit: Fit) -> list[str]:
    """Root-mean-square residual over noise: single logs, and the stepped sines of a data set together."""
    lines = []
    sines: dict[tuple[str, str, str], list[float]] = {}
    for record in fit.records:
        for name, value in record.rms.items():
            if record.harmonics:
                sines.setdefault((record.dataset, record.use, name), []).append(value)
            else:
                lines.append(f"{record.source} ({record.use}), {name}: residual {value:.3f} of the noise")
    for (dataset, use, name), values in sines.items():
        together = math.sqrt(sum(v * v for v in values) / len(values))
        lines.append(f"{len(values)} stepped sines of {dataset} ({use}), {name}: residual {together:.3f} of the noise")
    return lines


def fit_data(fit: Fit) -> dict[str, Any]:
    """Everything a Fit holds but the samples; numbers are finite or None, parameters in the variables' units."""
    return {
        "model": fit.model,
        "objective": fit.objective,
        "optimiser": fit.optimiser,
        "outcome": fit.outcome.name.lower(),
        "message": fit.message,
        "converged": fit.outcome is FitOutcome.CONVERGED,
        "iterations": fit.iterations,
        "cost": json_number(fit.cost),
        "start_cost": json_number(fit.start_cost),
        "misfit": json_number(fit.misfit),
        "values": dict(fit.values),
        "estimates": {e.name: _estimate(e) for e in fit.estimates},
        "covariance": [[json_number(v) for v in row] for row in fit.covariance.tolist()],
        "correlation": [[json_number(v) for v in row] for row in fit.correlation.tolist()],
        "undetermined": [
            {"exponents": dict(d.exponents), "spread": json_number(d.spread), "words": d.words}
            for d in fit.undetermined
        ],
        "combinations": [
            {"name": c.name, "exponents": dict(c.exponents), "value": c.value, "interval": list(c.interval)}
            for c in fit.combinations
        ],
        "records": [_record(record) for record in fit.records],
        "responses": [_response(response) for response in fit.responses],
        "starts": [
            {
                "name": s.name,
                "values": dict(s.values),
                "first_cost": json_number(s.first_cost),
                "cost": json_number(s.cost),
            }
            for s in fit.starts
        ],
        "notes": list(fit.notes),
    }


def _estimate(e: Estimate) -> dict[str, Any]:
    return {
        "value": e.value,
        "unit": e.unit,
        "start": e.start,
        "lower": json_number(e.lower),
        "upper": json_number(e.upper),
        "std": json_number(e.std),
        "interval": [json_number(v) for v in e.interval],
        "at_bound": e.at,
        "determined": e.determined,
    }


def _record(record: RecordFit) -> dict[str, Any]:
    return {
        "dataset": record.dataset,
        "source": record.source,
        "kind": record.kind,
        "use": record.use,
        "samples": int(record.measured.time.size),
        "rms_over_noise": record.rms,
        "criteria": {
            name: {d.criterion.symbol: {"value": d.value, "limit": d.criterion.limit} for d in deviations}
            for name, deviations in record.deviations.items()
        },
    }


def _response(response: ResponseFit) -> dict[str, Any]:
    test = response.comparison.measured.test
    return {
        "dataset": response.dataset,
        "use": response.use,
        "offset": test.offset,
        "amplitude": test.amplitude,
        "output": test.output,
        "criteria": {d.criterion.symbol: float(d.value) for d in response.comparison.deviations},
        "passes": response.comparison.passes,
    }


def fit_page(fit: Fit, *, units: Mapping[str, str], pictures: Sequence[tuple[str, bytes]], redo: str) -> str:
    """A self-contained page: outcome, estimates, what is not determined, records, responses, pictures.

    Args:
        units: of the inputs, by name.
        pictures: captions with their SVG.
        redo: the command line that makes it again.
    """
    verdict = [
        f"The search {outcome_text(fit)} after {fit.iterations} points.",
        f"Cost {fit.cost:.6g}, from {fit.start_cost:.6g} at the start.",
        f"Root-mean-square weighted residual: {fit.misfit:.3f} (1: nothing but noise is left).",
    ]
    parts = [heading("Outcome"), items([*verdict, *fit.notes]), heading("Parameters"), _estimates(fit)]
    if fit.undetermined:
        parts += [heading("What the data do not determine"), items(d.words for d in fit.undetermined)]
        parts += [_combinations(fit)] if fit.combinations else []
    parts += [heading("What each record leaves over"), _records(fit)]
    parts += [_responses(fit, units)] if fit.responses else []
    parts += [heading("Pictures"), *(picture(svg, caption) for caption, svg in pictures)]
    parts += [paragraph(_METHOD), heading("Do it again"), commands(redo)]
    return page("A model fitted to its measurements", f"{fit.model}; {fit.objective}; {fit.optimiser}.", parts)


_METHOD = (
    "Intervals are to first order around the estimates, widened by the residual where the model does not fit to the "
    "noise; at a bound they are one-sided. Records marked validate had no part in the fit."
)


def _estimates(fit: Fit) -> str:
    rows = []
    for e in fit.estimates:
        told = f"at its {e.at} bound" if e.at else "" if e.determined else "not determined by itself"
        numbers = (e.value, *e.interval, e.start, e.lower, e.upper)
        rows.append([cell(e.name), cell(e.unit), *(cell(f"{v:.5g}") for v in numbers), cell(told, "words")])
    head = ["parameter", "unit", "estimate", "95 % from", "to", "start", "lower", "upper", ""]
    return table("Estimates with 95 percent intervals", head, rows)


def _combinations(fit: Fit) -> str:
    rows = [[cell(c.name), *(cell(f"{v:.5g}") for v in (c.value, *c.interval))] for c in fit.combinations]
    caption = "Combinations that are determined (product of the parameters' units)"
    return table(caption, ["", "value", "95 % from", "to"], rows)


def _records(fit: Fit) -> str:
    rows = []
    for record in fit.records:
        for name, value in record.rms.items():
            kind = "beyond" if value > 1.5 else ""
            limits = [f"{d.criterion.symbol} {d.value:.2f} {d.criterion.unit}" for d in record.deviations.get(name, ())]
            texts = (record.dataset, record.source, record.use, name)
            rows.append([*(cell(text, "words") for text in texts), cell(f"{value:.3f}", kind), cell("; ".join(limits))])
    head = ["data set", "record", "use", "signal", "residual / noise", "Table 1.4 (limits 2 % and 10 %)"]
    return table("Root-mean-square residual over the noise", head, rows)


def _responses(fit: Fit, units: Mapping[str, str]) -> str:
    rows, head = [], ["data set", "use", "offset", "amplitude", "signal"]
    kinds = set(units.values())
    only = kinds.pop() if len(kinds) == 1 else "1"  # stepped sines do not tell which input swung
    for response in fit.responses:
        test, deviations = response.comparison.measured.test, response.comparison.deviations
        unit = units.get(test.input, only)
        offset, amplitude = (shown_value(value, unit) for value in (test.offset, test.amplitude))
        texts = (response.dataset, response.use, offset, amplitude, test.output)
        verdict = cell("pass", "pass") if response.comparison.passes else cell("fail", "fail")
        numbers = [cell(f"{d.value:.2f}", "" if d.passes else "beyond") for d in deviations]
        rows.append([*(cell(text) for text in texts), *numbers, verdict])
        names = [f"{d.criterion.symbol} ({d.criterion.unit}, limit {d.criterion.limit:g})" for d in deviations]
    return table("Frequency responses by thesis Table 1.3", [*head, *names, ""], rows)
