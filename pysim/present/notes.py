"""The words of every note: results carry codes and values, and this is where they become sentences."""

from __future__ import annotations

from pysim.io import shown_value
from pysim.types.note import Note, NoteCode

SHUT = "in none of the libraries"  # said of a model's class
_WORDS = {
    NoteCode.NOISE_ESTIMATED: (
        "{dataset}: no noise is specified for {signal}; a standard deviation of {shown} was estimated from the data."
    ),
    NoteCode.NOISE_ASSUMED: (
        "{dataset}: a table of responses states no noise; a standard deviation of {shown} was assumed for each point."
    ),
    NoteCode.RECORD_LEFT_OUT: "{record} was left out: {reason}.",
    NoteCode.NOT_SIMULATED: "{record}: the model could not be run through it at step {step}.",
    NoteCode.NOT_TRIED: "{effect} was not tried: {reason}.",
    NoteCode.HELD: "The data do not determine {parameter}; it was held at its value, and the intervals hold for that.",
    NoteCode.AT_BOUND: "{parameter} stopped at its bound {shown}; the true value may lie beyond it.",
    NoteCode.USED_TO_CHOOSE: "{records}: these validation data also chose between models; their error is optimistic.",
    NoteCode.INTERVAL_CONDITIONAL: "Intervals hold for the chosen model; they ignore that another one may be right.",
    NoteCode.TABLES_LEFT_OUT: (
        "left out: tables of frequency responses ({count:.0f}) beside logs over time; they need a data set of their own"
    ),
    NoteCode.HELD_AS_SET: "held as set, not refitted: {parameters}; --free refits them from there",
    NoteCode.BUILT_WITH: "built with values of its own, which every candidate has too: {parameters}",
    NoteCode.NO_EFFECT_FITS: "no slot of {model} takes an effect of the libraries, so none could be tried",
    NoteCode.CLASS_UNKNOWN: f"{{model}} is {SHUT}, so no effect can be added; name its library with --library",
    NoteCode.SEEN_FROM_OUTSIDE: (
        "looked at were the inputs {inputs} and the outputs {outputs} of {model}, nothing inside it: neither its "
        "{states:.0f} states nor the terms of their equations"
    ),
    NoteCode.OTHER: "{text}",
}


def words(note: Note) -> str:
    """One note as a sentence.

    Raises:
        KeyError: a value that belongs to the note's code is missing, which is our mistake.
    """
    values = dict(note.values)
    number, unit = values.get("value", values.get("bound")), str(values.get("unit", "1"))
    if not isinstance(number, str) and number is not None:
        values["shown"] = shown_value(float(number), unit, ".3g")
    elif number is not None:
        values["shown"] = number
    return _WORDS[note.code].format_map(values)
