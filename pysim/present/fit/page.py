"""A fit as a page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from pysim.identify.greybox import fit_warnings
from pysim.io import shown_value
from pysim.present.fit.answer import Fitted, gain_text, outcome_text
from pysim.present.notes import USES, estimate_words, words
from pysim.present.page import cell, heading, items, paragraph, pictures, table
from pysim.present.page import page as whole_page
from pysim.present.render import Drawing
from pysim.types import Estimate, Fit


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
    notes = [words(note) for note in fit.notes if note not in warnings]
    parts = [heading("Outcome"), items([*verdict, *notes])]
    parts += [heading("When not to trust it"), items(map(words, warnings))] if warnings else []
    parts += [heading("Parameters"), _estimates(fit.estimates, "Estimates with 95 percent intervals")]
    parts += [_estimates(fit.initial, "States at the first sample of a log, estimated from it")] if fit.initial else []
    parts += [_combinations(fit)] if fit.combinations else []
    parts += [heading("What each record leaves over"), _records(fit)]
    parts += [_responses(fit, units)] if fit.responses else []
    parts += [heading("Pictures"), *pictures(drawings)]
    parts.append(paragraph(_METHOD))
    lead = f"{fit.model}; {fit.objective}; {fit.optimiser}."
    return whole_page("A model fitted to its measurements", lead, parts, redo)


_METHOD = (
    "Intervals are to first order around the estimates, widened by the residual where the model does not fit to the "
    "noise; at a bound they are one-sided. Only records marked fitted had a part in the fit."
)


def _estimates(estimates: Sequence[Estimate], caption: str) -> str:
    rows = []
    for e in estimates:
        numbers = (e.value, *e.interval, e.start, e.lower, e.upper)
        rows.append([e.name, e.unit, *(f"{v:.5g}" for v in numbers), estimate_words(e)])
    head = ["parameter", "unit", "estimate", "95 % from", "to", "start", "lower", "upper", ""]
    return table(caption, head, rows, words=[8])


def _combinations(fit: Fit) -> str:
    rows = [[c.name, *(f"{v:.5g}" for v in (c.value, *c.interval))] for c in fit.combinations]
    caption = "Combinations that are determined (product of the parameters' units)"
    return table(caption, ["", "value", "95 % from", "to"], rows)


def _records(fit: Fit) -> str:
    rows = []
    for record in fit.records:
        for name, value in record.rms.items():
            kind = "beyond" if value > 1.5 else ""
            limits = [f"{d.criterion.symbol} {d.value:.2f} {d.criterion.unit}" for d in record.deviations.get(name, ())]
            texts = (record.dataset, record.source, USES[record.use], name)
            rows.append([*texts, cell(f"{value:.3f}", kind), "; ".join(limits)])
    head = ["data set", "record", "use", "signal", "residual / noise", "Table 1.4 (limits 2 % and 10 %)"]
    return table("Root-mean-square residual over the noise", head, rows, words=range(4))


def _responses(fit: Fit, units: Mapping[str, str]) -> str:
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
