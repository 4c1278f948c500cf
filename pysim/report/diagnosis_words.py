"""What a diagnosis says, in plain sentences."""

from __future__ import annotations

import math
from collections.abc import Sequence

from pysim.types import AddedEffect, Diagnosis, Estimate, LedgerStep
from pysim.types.diagnosis import NONE, UNKNOWN


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
        return f"More is missing than could be named: {_and(names)} {verb} asked for, and is not all.{fall}"
    count = "an effect" if len(names) == 1 else f"{len(names)} effects"
    return f"The model lacks {count}: {_and(names)}.{_tie(diagnosis)}{fall}"


def _named(one: AddedEffect) -> str:
    """What it is, and its standard name."""
    what = one.effect.description.removesuffix(f"({one.effect.name})").strip()
    return f"{what[0].lower()}{what[1:]} ({one.effect.name})" if what else one.effect.name


def _tie(diagnosis: Diagnosis) -> str:
    added = {one.effect.name for one in diagnosis.added}
    groups = [[name for name in group if name not in added] for group in diagnosis.confusable if added & set(group)]
    return "".join(f" These data do not tell it from {_and(rest)}." for rest in groups if rest)


def _fall(steps: Sequence[LedgerStep]) -> str:
    """From the refitted base model to the last step."""
    base, last = next((s for s in steps if s.step == "refit"), steps[0]), steps[-1]
    parts = [
        f"from {before:.2f} to {after:.2f} times the noise on what was {what}"
        for what, before, after in (("fitted", base.fit, last.fit), ("held out", base.validate, last.validate))
        if before is not None and after is not None
    ]
    return f"With {'it' if len(steps) < 4 else 'them'} the error falls {_and(parts)}." if parts else ""


def _left(diagnosis: Diagnosis) -> str:
    last = diagnosis.error[-1] if diagnosis.error else None
    if last is None or last.fit is None:
        return ""
    held = "" if last.validate is None else f", {last.validate:.2f} on what was held out"
    return f" What is left is {last.fit:.2f} times the noise on what was fitted{held}."


def _and(words: Sequence[str]) -> str:
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)


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
