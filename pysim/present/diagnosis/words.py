"""What a diagnosis says, in plain sentences; every residual is in standard deviations of the noise."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from pysim.identify.accuracy import FREQUENCY_CRITERIA, TIME_CRITERIA
from pysim.io import counted
from pysim.present.diagnosis.law_words import law_sentence
from pysim.present.notes import USES, listed
from pysim.types import Criterion, Diagnosis, ErrorStep, FoundEffect, Left, NextTest, NoteCode, RecordFit, Rival
from pysim.types.answer import NONE, PRIOR, REFIT, UNKNOWN, PlannedTest

LEFT_OUT = "leaving it out costs"  # a share of the misfit; what a candidate explains is what adding it takes
UNIT = "standard deviations of the noise"
BEYOND = 1.5  # residual above which a model fails, though wider limits may hold
_BY_TABLE = (FREQUENCY_CRITERIA, TIME_CRITERIA)
_UNITS = {"%": "% of full scale", "deg": "degrees"}


def step_name(step: str) -> str:
    """A step of the error history as people call it."""
    return {PRIOR: "as it is", REFIT: "refitted"}.get(step, f"+ {called(*step.split(' + '))}")


def last_name(diagnosis: Diagnosis) -> str:
    """The last model of the error history by all that it has: the history names each step by its last part alone."""
    if diagnosis.last is None:
        return step_name(diagnosis.history[-1].step) if diagnosis.history else ""
    steps = [one.step for one in diagnosis.history if one.step not in (PRIOR, REFIT)]
    parts = [called(part) for step in steps for part in step.split(" + ")]
    names = list(dict.fromkeys([*parts[:-1], *map(found_name, diagnosis.effects), parts[-1]]))
    return f"with {listed(names)}" if len(names) < 3 else f"with all {len(names)} additions"


def verdict_words(diagnosis: Diagnosis) -> str:
    """The verdict in a few words: every effect that is missing."""
    return listed([*map(found_name, diagnosis.effects)]) or diagnosis.verdict


def called(*names: str) -> str:
    """Effects as people call them, joined: by their standard names, errors of sensors in words."""
    return " + ".join(re.sub(r"^sensor\.(\w+) .*?([^.]+)$", r"\1 of the sensor of \2", name) for name in names)


def found_name(one: FoundEffect) -> str:
    """The same of an effect that was found."""
    return one.effect.name if one.effect.class_name else called(f"{one.effect.name} {one.place}")


def errors(step: ErrorStep | Left) -> dict[str, float]:
    """The residual on the logs of each use, as far as there are any."""
    values = (step.fit, step.validate, step.test if isinstance(step, ErrorStep) else None)
    return {use: value for use, value in zip(USES.values(), values, strict=True) if value is not None}


def _on_logs(use: str) -> str:
    return f"on logs {use}" if use == USES["validate"] else f"on {use.replace(' ', '-')} logs"


def verdict_sentence(diagnosis: Diagnosis) -> str:
    """The answer, with what it does to the error, and what is left."""
    laws = list(map(law_sentence, diagnosis.likeliest))
    if diagnosis.verdict == NONE:
        return f"Nothing is missing: the refitted model explains the measurements. {_left(diagnosis)}"
    if diagnosis.verdict == UNKNOWN:
        if diagnosis.learned:
            rest = _rest(diagnosis) if diagnosis.complete else _left(diagnosis)
            return " ".join(
                filter(None, [*laws, "No effect of the catalogue explains the misfit.", _fall(diagnosis), rest])
            )
        tried = "Nothing that was tried explains it." if diagnosis.rivals else "No effect was tried."
        return " ".join([*(laws or ["Something is missing."]), tried, _left(diagnosis)])
    names = [_named(one) for one in diagnosis.effects]
    count = "an effect" if len(names) == 1 else f"{len(names)} effects"
    more = [_rest(diagnosis)] if diagnosis.all_named else ["More is missing than that.", *laws, _left(diagnosis)]
    lacks = f"The model lacks {count}: {listed(names)}." if diagnosis.rivals else _asked(diagnosis)
    return " ".join(filter(None, [lacks, _tie(diagnosis), _fall(diagnosis), *more]))


def _asked(diagnosis: Diagnosis) -> str:
    """Effects that nothing was compared with, and which of them the logs do not tell of."""
    idle = [one.effect.name for one in diagnosis.effects if one.share == 0]
    verb, who = ("changes", "it") if len(idle) == 1 else ("change", "them")
    needless = f" {listed(idle)} {verb} nothing that these logs show: take {who} out." if idle else ""
    return f"Added as asked: {listed([_named(one) for one in diagnosis.effects])}.{needless}"


def _rest(diagnosis: Diagnosis) -> str:
    """What is left where nothing is in it that was looked for: noise, up to 1.05 times it (`Settings.held_out`)."""
    size = diagnosis.left.fit or diagnosis.left.validate or 0.0
    if size <= 1.05:
        return "Nothing but noise is left."
    of_what = f"What is left is {size_text(size)} times the noise and follows none of the model's signals"
    return f"{of_what}: the noise is larger than assumed, or more is missing."


def _left(diagnosis: Diagnosis) -> str:
    """How large the residual is, and whether it follows the signals."""
    left = diagnosis.left
    parts = [f"{value:.2f} {_on_logs(use)}" for use, value in errors(left).items() if value]
    size = f"The residual is {listed(parts)}, in {UNIT}." if parts else "Only frequency responses were compared."
    if diagnosis.complete:
        return f"{size} {_rest(diagnosis)}"
    said = [size]
    if left.share_explained is not None:
        said.append(f"{100 * left.share_explained:.0f} % of it follows the model's own signals.")
    if left.tone is not None:
        said.append(f"It holds a tone of {left.tone:.4g} Hz, which no effect of the catalogue gives.")
    if (odd := left.stands_out) is not None:
        said.append(f"In {odd.record}, {odd.signal} leaves {size_text(odd.over)} times what it leaves elsewhere.")
    return " ".join(said)


def comparison_sentence(diagnosis: Diagnosis) -> str:
    """How far the model is from its measurements, as it is and refitted, and where most."""
    texts = [_step_text(step) for step in diagnosis.history]
    if diagnosis.failures:
        worst = diagnosis.failures[0]
        texts.append(f"It fails most at {worst.record}, {worst.signal}: {worst.region} ({size_text(worst.error)}).")
    return " ".join(texts)


def _step_text(step: ErrorStep) -> str:
    who = {PRIOR: "As it is, the model", REFIT: "Refitted, it"}.get(
        step.step, f"With {called(*step.step.split(' + '))}, it"
    )
    parts = [f"{size_text(value)} {_on_logs(use)}" for use, value in errors(step).items()]
    left = f"leaves a residual of {listed(parts)}, in {UNIT}" if parts else "is judged by frequency responses alone"
    return f"{who} {left}. {limits_sentence(step)}".rstrip()


def ranking_sentence(diagnosis: Diagnosis) -> str:
    """Which candidates improve the fit; nothing is decided."""
    first = [row for row in diagnosis.rivals if len(row.effects) == 1]
    useful = [row for row in first if row.score > 0]
    count = len({row.effects[-1] for row in diagnosis.rivals})
    if not useful:
        return f"None of {count} candidates improves the fit enough to justify its extra parameters."
    names = [f"{called(row.effects[-1])} ({share_text(row.explained)} of the misfit)" for row in useful[:3]]
    best = ", ".join(names) + ("" if len(useful) <= 3 else ", ...")
    return f"{len(useful)} of {count} candidates improve the fit enough to justify their extra parameters: {best}."


def added_sentence(diagnosis: Diagnosis) -> str:
    """What the effects that were asked for do to the error."""
    return " ".join(filter(None, [_asked(diagnosis), _fall(diagnosis), limits_sentence(diagnosis.history[-1])]))


def candidates_shown(diagnosis: Diagnosis) -> list[Rival]:
    """All beside the base model, the best first; beside a model with effects those alone that improve it.

    Where nothing but noise is left, a share of the misfit says nothing.
    """
    alone = [row for row in diagnosis.rivals if len(row.effects) == 1]
    beside = [row for row in diagnosis.rivals if len(row.effects) > 1 and row.refitted and row.score > 0]
    return [*alone, *beside]


def learned_sentence(diagnosis: Diagnosis) -> str:
    """Where laws are missing most likely, and what they look like; the next places behind."""
    if not diagnosis.laws:
        return _nowhere(diagnosis)
    first = diagnosis.likeliest
    rest = [f"{one.slot} {share_text(one.share)}" for one in diagnosis.laws[len(first) :][:3]]
    return " ".join([*map(law_sentence, first), *([f"Other places: {', '.join(rest)}."] if rest else [])])


# A step of the diagnosis -> what it asks, and what answers that. All others ask which effect is missing.
QUESTIONS: Mapping[str, tuple[str, Callable[[Diagnosis], str]]] = {
    "compare": ("How far is the model from its measurements?", comparison_sentence),
    "locate": ("Where is what missing?", learned_sentence),
    "rank": ("What would each effect explain?", ranking_sentence),
    "add": ("What does the addition mend?", added_sentence),
}


def _nowhere(diagnosis: Diagnosis) -> str:
    """What is known where no place gave a law."""
    shut = any(note.code is NoteCode.CLASS_UNKNOWN for note in diagnosis.notes)
    of_model = "the model's inputs and outputs, and without its Modelica class nothing else can be looked at"
    text = f"No law could be learned at {of_model if shut else 'any place of the model'}."
    return f"{text} {_rest(diagnosis)}" if diagnosis.complete else text


def next_test_sentence(test: NextTest) -> str:
    """What to run and to log, and what that is worth."""
    assumed = [f"{name}, {noise:.2g}{_unit(unit)}" for name, (noise, unit) in test.assumed.items()]
    also = f" (new: {'; '.join(assumed)} of noise assumed)" if assumed else ""
    return (
        f"Run {'; '.join(map(_planned, test.tests))}. Log {', '.join(test.log)}{also}. It separates "
        f"{' from '.join(test.separates)}: expected difference of their sums of squares over noise {test.gain:.3g}."
    )


def _planned(test: PlannedTest) -> str:
    unit, seconds = _unit(test.unit), f"for {test.seconds:.3g} s"
    around = f" around {test.offset:.3g}{unit}" if test.sine or test.offset else ""
    if test.sine:
        return f"a sine of {test.frequency:.3g} Hz and {test.amplitude:.3g}{unit}{around} {seconds}"
    wave = f"a wave of {test.amplitude:.3g}{unit} significant height{around}"
    return f"{wave}, its peak at {test.frequency:.3g} Hz, {seconds}"


def _unit(unit: str) -> str:
    return "" if unit == "1" else f" {unit}"


def limits_sentence(step: ErrorStep) -> str:
    """Whether the limits of thesis Tables 1.3 and 1.4 are met, with the worst values and the limits themselves."""
    texts = []
    for criteria in _judging(step):
        values = []
        for c in criteria:
            how = "on average" if c.name.startswith("mean") else "at most"
            values.append(f"{_worst(step, c)} {_UNITS.get(c.unit, c.unit)} {how} (limit {c.limit:g})")
        texts.append(f"The limits of {criteria[0].source} are {_verdict(step, criteria)}: at worst {listed(values)}.")
    largest = max((value for value in (step.fit, step.validate) if value is not None), default=0.0)
    if texts and step.passes and largest > BEYOND:
        texts.append("These limits are wider than the noise: that they are met does not make the model complete.")
    if step.not_simulated:
        lost = counted(step.not_simulated, "record")
        texts.append(f"{lost} not simulated: how far the model is from what was measured there is not known.")
    return " ".join(texts)


def limits_words(step: ErrorStep) -> str:
    """The same in a few words."""
    lost = [f"{counted(step.not_simulated, 'record')} not simulated"] if step.not_simulated else []
    verdicts = [f"{own[0].source.removeprefix('thesis ')} {_verdict(step, own)}" for own in _judging(step)]
    return ", ".join([*verdicts, *lost])


def _verdict(step: ErrorStep, criteria: Sequence[Criterion]) -> str:
    """Limits that hold are met only where every record was simulated."""
    if not all(step.criteria[c.symbol] <= c.limit for c in criteria):
        return "not met"
    return "not judged" if step.not_simulated else "met"


def _judging(step: ErrorStep) -> list[list[Criterion]]:
    """The criteria that were applied, by table."""
    applied = [[c for c in criteria if c.symbol in step.criteria] for criteria in _BY_TABLE]
    return [criteria for criteria in applied if criteria]


def _worst(step: ErrorStep, criterion: Criterion) -> str:
    """Its worst value, with as many digits as tell it from its limit."""
    value = step.criteria[criterion.symbol]
    return next((text for text in (f"{value:.3g}", f"{value:.6g}") if float(text) != criterion.limit), f"{value:g}")


def _named(one: FoundEffect) -> str:
    """What it is, and its standard name."""
    what = one.effect.description.removesuffix(f"({one.effect.name})").strip()
    place = f" at {one.place}" if one.effect.class_name else ""
    return f"{what[0].lower()}{what[1:]} ({one.effect.name})" if what else f"{found_name(one)}{place}"


def _tie(diagnosis: Diagnosis) -> str:
    added = {one.effect.name for one in diagnosis.effects}
    groups = [[called(name) for name in group if name not in added] for group in diagnosis.ties if added & set(group)]
    return " ".join(f"These data cannot tell it from {listed(rest)}." for rest in groups if rest)


def _fall(diagnosis: Diagnosis) -> str:
    """What the effects, and a law that was learned, do to the residual of the refitted model."""
    steps = diagnosis.history
    if len(steps) < 2:
        return ""
    base, last = next((s for s in steps if s.step == REFIT), steps[0]), steps[-1]
    ends = errors(last)
    pairs = {use: (before, ends[use]) for use, before in errors(base).items() if use in ends}
    if not pairs:
        return ""
    told = [(_on_logs(use), size_text(one), size_text(other)) for use, (one, other) in pairs.items()]
    parts = [f"from {one} to {other} {where}" if one != other else f"at {one} {where}" for where, one, other in told]
    falls = all(after <= before for before, after in pairs.values())
    verb = "stays" if all(one == other for _, one, other in told) else "falls" if falls else "goes"
    who = ["it" if len(diagnosis.effects) == 1 else "them"] if diagnosis.effects else []
    who += [f"the learned law{'s' if len(diagnosis.learned) > 1 else ''}"] if diagnosis.learned else []
    return f"With {' and '.join(who)} the residual {verb} {listed(parts)}, in {UNIT}."


def signal_rows(records: Sequence[RecordFit]) -> list[tuple[str, str, float, float, float, str]]:
    """Signal, use of the logs, residual over noise, fit in percent, rms residual and its unit, over all logs."""
    sums: dict[tuple[str, str], list[float]] = {}
    units: dict[str, str] = {}
    for record in records:
        measured, residual = record.measured.values, record.measured.values - record.simulated.values
        for j, name in enumerate(record.measured.names):
            units.setdefault(name, record.measured.units[j])
            own = sums.setdefault((name, USES[record.use]), [0.0] * 4)
            own[0] += float(np.nansum((residual[:, j] / record.noise[j]) ** 2))
            own[1] += float(np.nansum(residual[:, j] ** 2))
            own[2] += float(np.nansum((measured[:, j] - np.nanmean(measured[:, j])) ** 2))
            own[3] += np.count_nonzero(np.isfinite(residual[:, j]))
    return [
        (name, use, math.sqrt(noise / count), 100 * (1 - math.sqrt(away / size)) if size else math.nan,
         math.sqrt(away / count), units[name])
        for (name, use), (noise, away, size, count) in sorted(sums.items())
    ]  # fmt: skip


def sizes(one: FoundEffect) -> list[tuple[str, float, tuple[float, float], str]]:
    """Name, value, 95 percent interval and unit of an effect's parameters, turned over where people speak of 1/x."""
    found = []
    for parameter, e in zip(one.effect.parameters, one.estimates, strict=True):
        found.append((parameter.name, e.value, e.interval, e.unit))
        if parameter.inverse:
            high, low = (1 / v if v else math.inf for v in e.interval)
            found.append((parameter.inverse, parameter.reported(e.value)[1], (low, high), f"1/({e.unit})"))
    return found


def size_text(value: float) -> str:
    """A residual over noise, three digits of it."""
    return f"{value:.2f}" if value < 10 else f"{value:.3g}"


def share_text(share: float) -> str:
    """A share of the misfit in percent."""
    return f"{100 * share:.1f} %"


def chance_text(p_value: float) -> str:
    """A chance, small ones as a bound."""
    return "< 1e-12" if p_value < 1e-12 else f"{p_value:.2g}"
