"""A fit as text for a terminal, as data for JSON and as files."""

from __future__ import annotations

import math
import textwrap
from dataclasses import dataclass
from typing import Any

from pysim.identify.greybox import Profile
from pysim.io import json_number
from pysim.present.notes import direction_words, words
from pysim.types import Dataset, Estimate, Fit, FitOutcome, RecordFit, ResponseFit

_WIDTH = 100


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
    lines += [_row(estimate) for estimate in fit.estimates]
    for direction in fit.undetermined:
        lines += textwrap.wrap(direction_words(direction), _WIDTH)
    lines += [f"  {c.name} = {c.value:.5g}, 95 % {c.interval[0]:.5g} to {c.interval[1]:.5g}" for c in fit.combinations]
    lines += [f"  {text}" for text in _left_over(fit)]
    for note in fit.notes:
        lines += textwrap.wrap(f"Note: {words(note)}", _WIDTH)
    lines += [f"Profile of {p.name}: 95 % from {p.interval[0]:.5g} to {p.interval[1]:.5g}" for p in result.profiles]
    return "\n".join(lines)


def outcome_text(fit: Fit) -> str:
    """How the search ended, and why."""
    return f"{fit.outcome.value} ({fit.message})" if fit.message else fit.outcome.value


def gain_text(fit: Fit) -> str:
    """What the search gained on the start; half a sum of squares, where the objective is one."""
    return f"the search lowered the cost by {fit.start_cost - fit.cost:.4g}"


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


def files(result: Fitted) -> dict[str, str]:
    """The fitted values, as `--parameters` takes them."""
    lines = [f'"{name}" = {value!r}' for name, value in result.fit.values.items() if "@" not in name]
    return {"parameters.toml": "\n".join([*lines, ""])}


def data(result: Fitted) -> dict[str, Any]:
    """Everything a fit holds but the samples; numbers are finite or None, parameters in the variables' units."""
    return _data(result.fit) | {"profiles": {p.name: _profile(p) for p in result.profiles}}


def _profile(profile: Profile) -> dict[str, Any]:
    return {
        "interval": [json_number(end) for end in profile.interval],
        "points": [[json_number(v) for v in point] for point in profile.points.tolist()],
    }


def _data(fit: Fit) -> dict[str, Any]:
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
            {"exponents": dict(d.exponents), "spread": json_number(d.spread), "words": direction_words(d)}
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
        "notes": [words(note) for note in fit.notes],
        "note_codes": [note.code.value for note in fit.notes],
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
