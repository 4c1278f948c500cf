"""What a diagnosis says, in plain sentences."""

from __future__ import annotations

import math
from collections.abc import Sequence

from pysim.identify.accuracy import FREQUENCY_CRITERIA, TIME_CRITERIA
from pysim.io import counted
from pysim.present.notes import SHUT, listed, words
from pysim.types import AddedEffect, Criterion, Diagnosis, Estimate, LedgerStep, NextTest
from pysim.types.diagnosis import NONE, UNKNOWN

_BY_TABLE = (FREQUENCY_CRITERIA, TIME_CRITERIA)
_UNITS = {"%": "% of full scale", "deg": "degrees"}
_NOISE = 1.5  # times the noise: a model that leaves more than this fails, though limits that are wider may hold


def verdict_sentence(diagnosis: Diagnosis) -> str:
    """The answer, with what it does to the error."""
    names = [_named(one) for one in diagnosis.added]
    if diagnosis.verdict == NONE:
        return (
            f"Nothing is missing: the refitted model explains the measurements down to their noise.{_left(diagnosis)}"
        )
    if diagnosis.verdict == UNKNOWN and not names:
        return f"The model fails, and no effect that was tried explains it: {diagnosis.reason}."
    fall = f" {_fall(diagnosis.error)}" if diagnosis.error else ""
    if diagnosis.verdict == UNKNOWN:
        verb = "is" if len(names) == 1 else "are"
        return f"More is missing than could be named: {listed(names)} {verb} asked for, and is not all.{fall}"
    count = "an effect" if len(names) == 1 else f"{len(names)} effects"
    more = "" if diagnosis.complete is not False else " More is missing than that."
    return f"The model lacks {count}: {listed(names)}.{more}{_tie(diagnosis)}{fall}"


def what_is_left_sentence(diagnosis: Diagnosis) -> str:
    """Why a verdict without effects is what it is: how large the residual is, and whether it follows the signals."""
    fit, _, share, _ = diagnosis.left or (None, None, None, None)
    size = "" if fit is None else f"the residual is {fit:.3g} times its noise floor"
    if share is None:
        follows = "the logs are too short to say whether it follows the model's own signals"
    else:
        follows = f"{100 * share:.0f} % of it follows the model's own signals"
    return f"{size or 'the residual was judged by responses alone'}, and {follows}"


def comparison_sentence(diagnosis: Diagnosis) -> str:
    """How far the model is from its measurements, as it is and refitted, and where most."""
    texts = [_step_text(step) for step in diagnosis.error]
    if diagnosis.where:
        worst = diagnosis.where[0]
        texts.append(f"It fails most at {worst.record}, {worst.signal}: {worst.region} ({worst.error:.2f}).")
    return " ".join(texts)


def _step_text(step: LedgerStep) -> str:
    who = {"prior": "As it is, the model", "refit": "Refitted, it"}.get(step.step, f"With {step.step}, it")
    values = (("fitted", step.fit), ("held out", step.validate))
    parts = [f"{value:.2f} times the noise on what is {what}" for what, value in values if value is not None]
    left = f"leaves {listed(parts)}" if parts else "is judged by responses alone"
    return f"{who} {left}. {limits_sentence(step)}"


def limits_sentence(step: LedgerStep) -> str:
    """Whether the limits of thesis Tables 1.3 and 1.4 are met, with the worst values and the limits themselves."""
    texts = []
    for criteria in _judging(step):
        values = [f"{_worst(step, c)} {_UNITS.get(c.unit, c.unit)} {_how(c)} (limit {c.limit:g})" for c in criteria]
        texts.append(f"{_capital(criteria[0].source)} is {_verdict(step, criteria)}: at worst {listed(values)}.")
    largest = max((value for value in (step.fit, step.validate) if value is not None), default=0.0)
    if texts and step.passes and largest > _NOISE:
        texts.append("These limits are wider than the noise: that they are met does not make the model complete.")
    texts = texts or ["Nothing was compared that thesis Tables 1.3 and 1.4 have limits for."]
    if step.not_simulated:
        texts.append(f"{_capital(_lost(step))}: how far the model is from what was measured there is not known.")
    return " ".join(texts)


def limits_words(step: LedgerStep) -> str:
    """The same in a few words."""
    verdicts = [
        f"{criteria[0].source.removeprefix('thesis ')} {_verdict(step, criteria)}" for criteria in _judging(step)
    ] or ["no limits"]
    return ", ".join([*verdicts, *([_lost(step)] if step.not_simulated else [])])


def _verdict(step: LedgerStep, criteria: Sequence[Criterion]) -> str:
    """Limits that hold are met only where every record was simulated."""
    if not _holds(step, criteria):
        return "not met"
    return "not judged" if step.not_simulated else "met"


def _lost(step: LedgerStep) -> str:
    return f"{counted(step.not_simulated, 'record')} not simulated"


def _judging(step: LedgerStep) -> list[list[Criterion]]:
    """The criteria that were applied, by table."""
    applied = [[c for c in criteria if c.symbol in step.criteria] for criteria in _BY_TABLE]
    return [criteria for criteria in applied if criteria]


def _holds(step: LedgerStep, criteria: Sequence[Criterion]) -> bool:
    return all(step.criteria[c.symbol] <= c.limit for c in criteria)


def _worst(step: LedgerStep, criterion: Criterion) -> str:
    """Its worst value, with as many digits as tell it from its limit."""
    value = step.criteria[criterion.symbol]
    return next((text for text in (f"{value:.3g}", f"{value:.6g}") if float(text) != criterion.limit), f"{value:g}")


def _how(criterion: Criterion) -> str:
    return "on average" if criterion.name.startswith("mean") else "at most"


def _capital(text: str) -> str:
    return f"{text[0].upper()}{text[1:]}"


def ranking_sentence(diagnosis: Diagnosis) -> str:
    """Which candidates pay; nothing is decided."""
    paying = [row for row in diagnosis.ranking if row.score > 0 and row.round == 1]
    count = len({row.effect for row in diagnosis.ranking})
    if not paying:
        return f"None of {count} candidates improves the fit enough to justify its extra parameters."
    names = [f"{row.effect} ({share_text(row.explained)} of the misfit)" for row in paying[:3]]
    best = ", ".join(names) + ("" if len(paying) <= 3 else ", ...")
    return f"{len(paying)} of {count} candidates improve the fit enough to justify their extra parameters: {best}."


def missing_sentence(diagnosis: Diagnosis) -> str:
    """Where a term is missing most likely, and what it looks like."""
    if not diagnosis.missing:
        return _nowhere(diagnosis)
    first = diagnosis.missing[0]
    shape = f"; {first.formula}" if first.formula else ""
    texts = [f"What is missing fits best at {first.slot}, over {first.depends_on}{shape}."]
    texts.append(f"It takes {share_text(first.share)} of the misfit.")
    if first.alike:
        texts.append(f"These data do not tell it from a term at {', '.join(first.alike)}.")
    rest = [f"{one.slot} {share_text(one.share)}" for one in diagnosis.missing[1:4]]
    return " ".join([*texts, *([f"Next: {', '.join(rest)}."] if rest else [])])


def _nowhere(diagnosis: Diagnosis) -> str:
    """What is known where no place gave a term; of causes only the one that a note tells."""
    shut = any(SHUT in words(note) for note in diagnosis.notes)
    of_model = "the model's inputs and outputs, and without its Modelica class nothing else can be looked at"
    text = f"No term could be estimated at {of_model if shut else 'any place of the model'}."
    explained = " The model explains the measurements down to their noise without one."
    return f"{text}{explained if diagnosis.verdict == NONE else ''}"


def next_test_sentence(test: NextTest) -> str:
    """What to run and to log, and what that is worth."""
    return (
        f"{test.about} It separates {' from '.join(test.separates)}: expected difference of their sums of squares over "
        f"noise {test.gain:.3g}."
    )


def added_sentence(diagnosis: Diagnosis) -> str:
    """What the effects that were asked for do to the error."""
    last = diagnosis.error[-1]
    names = listed([_named(one) for one in diagnosis.added])
    return f"Added as asked: {names}. {_fall(diagnosis.error)} {limits_sentence(last)}"


def _named(one: AddedEffect) -> str:
    """What it is, and its standard name."""
    what = one.effect.description.removesuffix(f"({one.effect.name})").strip()
    return f"{what[0].lower()}{what[1:]} ({one.effect.name})" if what else one.effect.name


def _tie(diagnosis: Diagnosis) -> str:
    added = {one.effect.name for one in diagnosis.added}
    groups = [[name for name in group if name not in added] for group in diagnosis.confusable if added & set(group)]
    return "".join(f" These data do not tell it from {listed(rest)}." for rest in groups if rest)


def _fall(steps: Sequence[LedgerStep]) -> str:
    """From the refitted base model to the last step."""
    base, last = next((s for s in steps if s.step == "refit"), steps[0]), steps[-1]
    parts = [
        f"from {before:.2f} to {after:.2f} times the noise on what was {what}"
        for what, before, after in (("fitted", base.fit, last.fit), ("held out", base.validate, last.validate))
        if before is not None and after is not None
    ]
    return f"With {'it' if len(steps) < 4 else 'them'} the error falls {listed(parts)}." if parts else ""


def _left(diagnosis: Diagnosis) -> str:
    last = diagnosis.error[-1] if diagnosis.error else None
    if last is None or last.fit is None:
        return ""
    held = "" if last.validate is None else f", {last.validate:.2f} on what was held out"
    return f" What is left is {last.fit:.2f} times the noise on what was fitted{held}."


def sizes(one: AddedEffect) -> list[tuple[str, float, tuple[float, float], str]]:
    """Name, value, 95 percent interval and unit of an effect's parameters, turned over where people speak of 1/x."""
    found = []
    for parameter, e in zip(one.effect.parameters, one.estimates, strict=True):
        found.append((parameter.name, e.value, e.interval, e.unit))
        if parameter.inverse:
            high, low = (1 / v if v else math.inf for v in e.interval)
            found.append((parameter.inverse, parameter.reported(e.value)[1], (low, high), f"1/({e.unit})"))
    return found


def remark(estimate: Estimate, *, held: bool = False) -> str:
    """What a reader must know of an estimate."""
    if held:
        return "held: sets the scale of others"
    if estimate.at:
        return f"at its {estimate.at} bound"
    return "" if estimate.determined else "not determined by itself"


def share_text(share: float) -> str:
    """A share of the misfit in percent."""
    return f"{100 * share:.1f} %"


def chance_text(p_value: float) -> str:
    """A chance, small ones as a bound."""
    return "< 1e-12" if p_value < 1e-12 else f"{p_value:.2g}"
