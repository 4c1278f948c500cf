"""The words of every note: results carry codes and values, and this is where they become sentences."""

from __future__ import annotations

import math
from collections.abc import Sequence

from pysim.io import shown_value
from pysim.types import Direction, Estimate
from pysim.types.note import Note, NoteCode

_WORDS = {
    NoteCode.NOISE_ESTIMATED: (
        "{dataset}: no noise is specified for {signal}; a standard deviation of {shown} was estimated from the data."
    ),
    NoteCode.NOISE_ASSUMED: (
        "{dataset}: tables of responses specify no noise; standard deviations of {magnitude:.2g} dB and {phase:.2g} "
        "degrees were assumed for each point (thesis Eq. 2.25)."
    ),
    NoteCode.NOT_COMPARED: "{record} was left out: none of its columns is compared.",
    NoteCode.NOT_WIRED: (
        "{outputs} goes nowhere and nothing drives {inputs}, which stays at its start value: add a wire "
        "'{output}': '{input}', or give {input} a value under inputs."
    ),
    NoteCode.NOT_SETTLED: (
        "{record}{more}: the first period is unlike those after it. Either the plant had not settled, or the noise has "
        "a long memory. The log is compared sample by sample from its start."
    ),
    NoteCode.NOT_SIMULATED: "{record} could not be simulated: {reason}",
    NoteCode.NOT_TRIED: "{effect} was not tried{next_to}: {reason}.",
    NoteCode.HELD: "The data do not determine {parameter}; it was held at its value, and the intervals hold for that.",
    NoteCode.BEYOND_BOUND: "{effect} would end beyond its bounds and is not named: widen them where it may go so far.",
    NoteCode.AT_BOUND: (
        "{parameter} stopped at its bound ({shown}): widen it if values beyond make sense, or fix the parameter."
    ),
    NoteCode.POOR_FIT: (
        "The fit is poor: the residuals of {signal} are {factor:.3g} standard deviations of the noise. The noise is "
        "larger than assumed, or the model lacks something: press Find what is missing, run pysim "
        "diagnose, or in Python pysim.diagnose(fitted)."
    ),
    NoteCode.CORRELATED: (
        "{first} and {second} are hardly distinguishable (correlation {correlation:.2f}). Fix one of them, or log what "
        "depends on one alone."
    ),
    NoteCode.NOT_AT_REST: (
        "The beginning of {record} does not fit a plant at rest. If the plant moved there, let this log begin where it "
        'stands still: data = data.trim(start=..., logs="{record}"), or write initial = "estimate" at this log in '
        "dataset.toml. If it stood still, look at the first samples, and leave them out where they are wrong."
    ),
    NoteCode.USED_TO_CHOOSE: (
        "{records}: these logs chose between models, so their error is optimistic. Hold a log out to have one that "
        "did not."
    ),
    NoteCode.INTERVAL_CONDITIONAL: "Intervals hold for the chosen model; they ignore that another one may be right.",
    NoteCode.INTERVAL_WIDTHS: (
        "The residuals are not white: the model, or the noise that was specified, is not right. The intervals allow "
        "for that. Compared with white residuals, they are this many times as wide: {widths}."
    ),
    NoteCode.FEW_BLOCKS: (
        "The data have fewer than {fewest:.0f} independent stretches. The intervals therefore rely on an estimate of "
        "how long the residuals' memory is."
    ),
    NoteCode.TABLES_LEFT_OUT: (
        "left out: tables of frequency responses ({count:.0f}) beside logs over time; they need a data set of their own"
    ),
    NoteCode.HELD_AS_SET: "held as set, not refitted: {parameters}; free them to refit them from there",
    NoteCode.BUILT_WITH: "built with values of its own, which every candidate has too: {parameters}",
    NoteCode.NO_EFFECT_FITS: "no slot of {model} takes an effect of the libraries, so none could be tried",
    NoteCode.CLASS_UNKNOWN: "{model} is in none of the libraries, so no effect can be added; name its library",
    NoteCode.SEEN_FROM_OUTSIDE: (
        "looked at were the inputs {inputs} and the outputs {outputs} of {model}, nothing inside it: neither its "
        "{states:.0f} states nor the terms of their equations"
    ),
    NoteCode.SEARCH_GAVE_UP: "The search gave up after {evaluations:.0f} evaluations; the result may not be the best.",
    NoteCode.BEYOND_NOISE: (
        "The residuals are {factor:.1f} times what the noise explains: the structure does not hold all of the "
        "response, or the system is not linear. Intervals are widened by that factor, which covers random deviations "
        "and not a wrong structure."
    ),
    NoteCode.DEAD_TIME_AT_BOUND: (
        "The dead time ended at the {end} that was allowed, {seconds:.4g} s, and counts as known."
    ),
    NoteCode.DEAD_TIME_AMBIGUOUS: (
        "A dead time of {seconds:.4g} s turns the phase by more than half a turn between any two measured frequencies: "
        "these data cannot tell it from others. It is meant in seconds."
    ),
    NoteCode.EDGE_OF_STABILITY: (
        "A pole ended at the edge of stability: without that condition the data ask for an unstable one, or for an "
        "integrator. It counts as known there, so the intervals are too narrow."
    ),
    NoteCode.INTEGRATOR: (
        "The pole at {frequency:.2g} Hz may be an integrator: it is slower than any measured frequency. "
        "The gain at rest is not determined; the response within the measured band is."
    ),
    NoteCode.UNSTABLE: (
        "{count:.0f} of {poles:.0f} poles are not left of the imaginary axis: not stable. A system that answers "
        "steadily is; ask for a stable fit."
    ),
    NoteCode.NOT_DETERMINED: (
        "The data do not determine {names}: other values give the same response. Ask for fewer poles and zeros."
    ),
    NoteCode.CANCELLING: (
        "The pole at {pole:.4g} Hz and the zero at {zero:.4g} Hz cannot be distinguished and cancel: the data support "
        "fewer of both."
    ),
    NoteCode.UNBOUNDED: (
        "{parameters}: refitted without bounds on both sides, since neither the model nor the call gives any. "
        "Give some with --bounds, or in Python with model.free(...)."
    ),
    NoteCode.NO_NEXT_TEST: "No test that would settle the tie was looked for: {reason}.",
    NoteCode.NO_LAW: "No law was learned: the best one, {law}, gains no more than chance would.",
    NoteCode.LAW_VETOED: (
        "No law was learned: the best one, {law}, makes the error worse on data that were not fitted to it."
    ),
    NoteCode.NO_LAW_RUNS: "No law was learned: none lowers the error of a model that can be simulated, at {places}.",
    NoteCode.LAWS_NOT_TRIED: "No law was looked for, since {effects} has events: slopes of such a model are no guide.",
    NoteCode.TRANSIENTS: ("the fitted period begins {seconds:.2g} s after the sine; the transients may not have died"),
    NoteCode.NO_HARMONICS: (
        "no samples from {begin:.4g} to {end:.4g} s: no harmonics are fitted, and others, where there are any, disturb "
        "the sine"
    ),
    NoteCode.FEW_HARMONICS: (
        "no samples from {begin:.4g} to {end:.4g} s: only {kept:.0f} of {count:.0f} harmonics are fitted, and others, "
        "where there are any, disturb the sine"
    ),
    NoteCode.DRIFTING: "the sine changes by {percent:.2g} percent within the fitted part; not settled, or not steady",
    NoteCode.MEMORY: "residuals have a memory; intervals follow their spectrum",
    NoteCode.MEMORY_IN_HARMONICS: (
        "residuals have a memory; intervals follow the harmonics, which a single period does not tell from noise"
    ),
    NoteCode.HARMONICS: (
        "harmonics beyond the noise at {count:.0f} of {points:.0f} frequencies, most at {frequency:g} Hz with "
        "{percent:.2g} percent: the response is not linear there"
    ),
    NoteCode.LOST_IN_NOISE: "tops and bottoms are lost in noise from {frequency:.3g} Hz on",
    NoteCode.FAST_SWEEP: (
        "below {frequency:.2g} Hz the frequency changes by more than half within a period; the response there is not a "
        "steady one"
    ),
    NoteCode.FEW_SAMPLES: (
        "at the high end there are {samples:.1f} samples per period; tops there lean on the sine's shape"
    ),
    NoteCode.OTHER: "{text}",
}


# Use of a log -> what was done with it. Held out is what nothing was fitted to, and nothing chosen with.
USES = {"fit": "fitted", "validate": "used to choose", "test": "held out"}
_EQUAL = 0.05  # share up to which a change is not worth saying; chosen: half of the tenth said where nothing is known
_MUCH = 1000.0  # factor beyond which its size says nothing; chosen: far beyond what anyone takes for a value
_OF_DIRECTION = {"@spread": math.inf, "@low": 0.0, "@high": math.inf}  # beside the exponents, and what stands for none
NOT_FITTED = "not fitted"  # either of the last two


def estimate_words(estimate: Estimate, *, held: bool = False) -> str:
    """What a reader must know of an estimate.

    Args:
        held: at its value, as the data give the others in relation to it alone.
    """
    if held:
        return "held: sets the scale of others"
    if estimate.at:
        return f"at its {estimate.at} bound"
    return "" if estimate.determined else "not determined by itself"


def direction_words(direction: Direction) -> str:
    """What the data do not tell apart, and how far: to the end of an interval, else one standard deviation, or a tenth
    where nothing is known."""
    first, *others = direction.exponents
    ends = [end for end in reversed(direction.reach) if 0 < end < math.inf]
    if not others:
        cure = "Fix it, or log what depends on it."
        if math.isinf(direction.spread):
            return f"These data do not determine {first}: any value within its bounds does as well. {cure}"
        changed = sorted(end ** direction.exponents[first] for end in ends or [_usual(direction)])
        sizes = " or ".join(_change(end) for end in changed if abs(end - 1) > _EQUAL)
        return f"These data hardly determine {first}{f': it may be {sizes}' if sizes else ''}. {cure}"
    said = f"These data do not tell {listed([*direction.exponents])} apart"
    scale = next((end for end in ends or [_usual(direction)] if abs(end - 1) > _EQUAL), None)
    if scale is not None:
        changes = {name: _change(scale**power) for name, power in direction.exponents.items()}
        said += f": {first} may be {changes[first]} if {listed([f'{name} is {changes[name]}' for name in others])}"
    return f"{said}. Fix one, or use their combinations."


def _usual(direction: Direction) -> float:
    """A factor that tells of a direction whose ends are not known."""
    return min(math.exp(direction.spread), _MUCH) if math.isfinite(direction.spread) else 1.1


def listed(texts: Sequence[str]) -> str:
    """Texts between commas, the last behind an "and"."""
    return " and ".join([", ".join(texts[:-1]), texts[-1]] if len(texts) > 1 else texts)


def _change(factor: float) -> str:
    if not 1 / _MUCH < factor < _MUCH:
        return f"more than {_MUCH:g} times {'as large' if factor > 1 else 'smaller'}"
    if factor >= 1:
        return f"{factor:.2g} times as large" if factor >= 2 else f"{100 * (factor - 1):.2g} % larger"
    return f"{1 / factor:.2g} times smaller" if factor <= 0.5 else f"{100 * (1 - factor):.2g} % smaller"


def sentences(notes: Sequence[Note]) -> list[str]:
    """Notes in sentences, in their order; parameters at their bounds share one, where the first of them stands."""
    ends = [note for note in notes if note.code is NoteCode.AT_BOUND]
    if len(ends) < 2:
        return [words(note) for note in notes]
    places = listed([f"{note.values['parameter']} ({_shown(note)})" for note in ends])
    text = f"{places} stopped at their bounds: widen those beyond which values make sense, or fix the parameters."
    kept = [note for note in notes if note.code is not NoteCode.AT_BOUND or note is ends[0]]
    return [text if note is ends[0] else words(note) for note in kept]


def words(note: Note) -> str:
    """One note in sentences; ahead of them the frequency that it is of, where its values have one as "at".

    Raises:
        KeyError: a value that belongs to the note's code is missing, which is our mistake.
    """
    values = dict(note.values)
    if note.code is NoteCode.INTERCHANGEABLE:
        spread, low, high = (float(values.pop(name, usual)) for name, usual in _OF_DIRECTION.items())
        return direction_words(Direction({name: float(value) for name, value in values.items()}, spread, (low, high)))
    if note.code is NoteCode.INTERVAL_WIDTHS:
        values = {"widths": ", ".join(f"{name} {value:.2g}" for name, value in values.items())}
    others = float(values.get("others", 0.0))
    values["more"] = f" and {others:.0f} more" if others else ""
    values["next_to"] = f" beside {values['beside']}" if "beside" in values else ""
    values |= {"shown": _shown(note)} if {"value", "bound"} & values.keys() else {}
    text = _WORDS[note.code].format_map(values)
    return f"{values['at']:g} Hz: {text}" if "at" in values else text


def _shown(note: Note) -> str:
    """Its number as people read it."""
    number = note.values["value" if "value" in note.values else "bound"]
    return number if isinstance(number, str) else shown_value(float(number), str(note.values.get("unit", "1")), ".3g")
