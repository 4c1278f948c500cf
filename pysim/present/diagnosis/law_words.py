"""A learned law in words: what is missing where, on what it depends, and what that does to the error."""

from __future__ import annotations

import math
import re

from pysim.present.notes import USES, listed
from pysim.types import LearnedLaw
from pysim.types.factor import Form

ABSORBED = "up to a level or slope that the model's own parameters do as well"  # how far such a curve is known
# What a law gives, by its unit: alone, and per unit of its factor.
_GIVES = {"N": "force", "N.m": "torque", "m3/s": "flow", "Pa": "pressure", "m": "displacement", "rad": "angle"}
_PER_FACTOR = {
    "N.s/m": "damping",
    "N.m.s/rad": "damping",
    "N.m.s": "damping",
    "N/m": "stiffness",
    "N.m/rad": "stiffness",
    "kg": "mass",
    "kg.m2": "moment of inertia",
    "m3/(s.Pa)": "flow conductance",
}


def law_kind(law: LearnedLaw) -> str:
    """What the law gives at its slot: "force", "damping"; "term" and "coefficient of v" where its unit says nothing."""
    form = law.factor.form
    if form in (Form.ONE, Form.TONE, Form.HYSTERESIS):
        return _GIVES.get(law.unit, "term")
    if form in (Form.SIGN, Form.BRISTLE) and law.unit in ("N", "N.m"):
        return "friction"
    return _PER_FACTOR.get(law.unit, f"coefficient of {law.factor}")


def formula_text(formula: str, factor: str, unit: str) -> str:
    """A learned law as it acts: its formula with the unit, times its factor; "" where no formula fits."""
    curve = formula if re.fullmatch(r"[-+.\de]+", formula) else f"({formula})"
    return " * ".join(filter(None, [f"{curve} {unit}".removesuffix(" 1"), factor])) if formula else ""


def law_sentence(law: LearnedLaw) -> str:
    """What is missing, how much of the misfit it explains, what it looks like, and what it does to the error."""
    kind = law_kind(law)
    on = "changes with time" if law.argument == "time" else f"depends on {law.argument}"
    if memory := _memory(law):
        size = "of constant size" if law.is_flat else f"whose size {on}"
        texts = [f"The model lacks a {kind} at {law.slot} {memory}, {size}."]
    elif law.factor.form is not Form.ONE and law.is_flat:
        texts = [f"The model lacks a {kind} at {law.slot} of constant size."]
    elif law.factor.form is not Form.ONE:
        texts = [f"The {kind} at {law.slot} is not constant: it {on}."]
    else:
        texts = [f"The model lacks {'an' if kind == 'angle' else 'a'} {kind} at {law.slot} that {on}."]
    texts.append(f"It explains {100 * law.share:.1f} % of the misfit.")
    if law.formula:
        texts.append(f"It looks like {formula_text(law.formula, str(law.factor), law.unit)}.")
    before, after = law.held_out
    if before is not None and after is not None:
        texts.append(f"On logs {USES['validate']} the residual goes from {before:.3g} to {after:.3g} with it.")
    if law.alternatives:
        texts.append(f"These data cannot tell it from a law at {listed(law.alternatives)}.")
    return " ".join(texts)


def _memory(law: LearnedLaw) -> str:
    """How a law remembers or hums; "" for other laws."""
    factor = law.factor
    if factor.form is Form.BRISTLE:
        unit = {"N": " m", "N.m": " rad"}.get(law.unit, "")
        return f"that remembers, by a bristle of {factor.number:.3g}{unit}"
    if factor.form is Form.HYSTERESIS:
        return f"that follows {factor.variable} behind a hysteresis of {factor.number:.3g}"
    return f"at {factor.rate / (2 * math.pi):.4g} Hz" if factor.form is Form.TONE else ""
