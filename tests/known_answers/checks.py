"""What is asked of an answer: functions of case and answer that name what is wrong, nothing where all is right."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from tests.known_answers.answer import Answer
from tests.known_answers.case import Case

_NEAR = 0.02  # of a true value, which an estimate may be off where its interval misses it
_WIDE = 0.25  # of a true value, which half an interval may be
_SHARE = 0.05
_REFIT = 0.05  # two standard deviations of the noise in 800 samples
_NOISE = 1.05  # error over noise of a good model on unseen logs
_HELD = 1.1  # and on a held-out log, three standard deviations of the noise in its 400 samples
Check = Callable[[Case, Answer], Iterator[str]]


def name(case: Case, answer: Answer) -> Iterator[str]:
    """The verdict."""
    if answer.data["verdict"] != case.right["verdict"]:
        yield f"verdict {answer.data['verdict']}, right is {case.right['verdict']}"


def effects(case: Case, answer: Answer) -> Iterator[str]:
    """The effects, the one whose leaving-out costs most first."""
    right, found = case.right.get("effects", []), answer.effects
    if found != right:
        yield f"effects {', '.join(found) or 'none'}, right are {', '.join(right) or 'none'}"


def shares(case: Case, answer: Answer) -> Iterator[str]:
    """What each effect takes alone of the avoidable misfit."""
    for effect, right in case.right.get("shares", {}).items():
        found = answer.share(effect)
        if found is None or abs(found - right) > _SHARE:
            yield f"{effect} takes {found}, right is {right}"


def refit(case: Case, answer: Answer) -> Iterator[str]:
    """The error that the refitted base model leaves of the fitted logs, over the noise that is there."""
    found = answer.data["error"][1]["fit"] * (max(case.logs.stated, 1.0))
    if abs(found / case.right["refit"] - 1) > _REFIT:
        yield f"the refitted base model leaves {found:.3f} times the noise, right is {case.right['refit']}"


def numbers(case: Case, answer: Answer) -> Iterator[str]:
    """Every number is in its interval or nearly so, and its interval says something."""
    for name, true in case.truth().items():
        if name not in answer.estimates:
            yield f"{name} was not estimated"
            continue
        value, low, high = answer.estimates[name]
        if not (low <= true <= high or abs(value - true) <= _NEAR * abs(true)):
            yield f"{name} {value:.5g}, {low:.5g} to {high:.5g}, right is {true:.5g}"
        if not high - low <= 2 * _WIDE * abs(true):
            yield f"{name} is between {low:.5g} and {high:.5g}, which says little"


def unseen(case: Case, answer: Answer) -> Iterator[str]:
    """On logs that the product never had, the model that was found is as good as the noise allows."""
    if answer.after > _NOISE:
        yield f"{answer.after:.3f} times the noise on unseen logs (as designed {answer.before:.3f})"


def held_out(case: Case, answer: Answer) -> Iterator[str]:
    """The product's own account of the held-out logs falls to the noise, counted in the noise that is there."""
    stated = max(case.logs.stated, 1.0)
    last = answer.data["error"][-1]["validate"]
    if case.logs.validate and not last * stated <= _HELD:
        yield f"held out {last * stated:.3f} times the noise, by its own account"


def place(case: Case, answer: Answer) -> Iterator[str]:
    """Of what is in no catalogue: where it acts, over what, and how much of the misfit that is."""
    right, found = case.right["missing"], answer.data["missing"]
    first = found[0] if found else {"slot": "", "depends_on": "", "share": 0.0}
    if (first["slot"], first["depends_on"]) != (right["slot"], right["depends_on"]):
        yield f"missing at {first['slot']} over {first['depends_on']}, right is {right['slot']}, {right['depends_on']}"
    elif first["share"] < right["share"]:
        yield f"what is missing takes {first['share']:.3f}, right is at least {right['share']}"


def contract(_: Case, answer: Answer) -> Iterator[str]:
    """The keys of the JSON and what they hold."""
    yield from answer.broken


CHECKS: Mapping[str, Check] = {
    "name": name,
    "effects": effects,
    "refit": refit,
    "shares": shares,
    "numbers": numbers,
    "unseen": unseen,
    "held_out": held_out,
    "place": place,
    "contract": contract,
}


def asked(case: Case) -> list[str]:
    """Which checks a case is put to: shares and place where their right answers are known, numbers where all are."""
    known = {"refit": "refit" in case.right, "shares": "shares" in case.right, "place": "missing" in case.right}
    known |= {"numbers": "missing" not in case.right, "unseen": "missing" not in case.right}
    return [name for name in CHECKS if known.get(name, True)]
