"""The benchmark's figures: how often the diagnosis is right, and what the models that it finds are worth."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise

import numpy as np

from validation.blind.benchmark.answer import Answer
from validation.shares import Share

KINDS = ("none", "named", "shaped", "beyond", "left-out", "pair")
DETECTABLE = 100.0
"""Detectability from which an effect ought to be named."""
_NOISE_ONLY = 1.05  # residual over noise
_RISE = 1.01  # times the residual of the step before
_SENSORS = {"offset": "sensor.offset", "gain": "sensor.gain", "shift": "sensor.delay", "drift": "sensor.drift"}


def figures(answers: Sequence[Answer]) -> Iterator[Share]:
    """How often names, their order and their absence are right."""
    named, none, shaped, pairs = (_of_kind(answers, kind) for kind in ("named", "none", "shaped", "pair"))
    whole = [a for a in pairs if not _hidden(a)]
    outside = [a for a in _of_kind(answers, "beyond") + _of_kind(answers, "left-out") if detectable(a)]
    large, small = [a for a in named if detectable(a)], [a for a in named if not detectable(a)]
    yield _share("right effect named first, detectability 100 or more", large, right_first, (95, 100))
    yield _share("right effect among the first two, detectability 100 or more", large, first_two, (99, 100))
    yield _share("another named first, in a tie with the right one, detectability 100 or more", large, tied)
    yield _share("an effect added beside the right one", named, lambda a: right_first(a) and len(a.named) > 1)
    yield _share("right effect named first, detectability below 100", small, right_first)
    yield _share("a wrong effect named, detectability below 100", small, _wrong)
    yield _share("right effect named first though its law has another shape", shaped, right_first, (80, 100))
    yield _share("a law of another shape said to be complete", shaped, lambda a: a.complete and not a.learned)
    yield _share("two effects at once, both named", pairs, _both)
    yield _share("the same, without pairs of which less than 100 remains", whole, _both, (85, 100))
    yield _share("an effect outside the catalogue answered with unknown", outside, lambda a: a.refuses, (90, 100))
    yield _share("a name given to an effect outside the catalogue", outside, lambda a: bool(a.named), (0, 5))
    yield _share("a law learned for an effect outside the catalogue", outside, lambda a: bool(a.learned))
    yield _share("a physical effect named although none is missing", none, lambda a: bool(a.named), (0, 1))
    yield _share("said to be incomplete although nothing is missing", none, lambda a: not a.complete, (0, 5))
    yield _share("a sensor's error named that is not there", answers, _false_sensor, (0, 5))
    repaired = [a for a in answers if a.named]
    yield _share("residual on unseen logs at most 1.05 of the noise once named", repaired, _noise_only, (95, 100))
    yield _share("a step that raised the residual on unseen logs", answers, _rises, (0, 0))
    yield _share("cases without an answer", answers, lambda a: bool(a.trouble), (0, 0))


def _of_kind(answers: Sequence[Answer], kind: str) -> list[Answer]:
    return [one for one in answers if one.kind == kind]


def _share(
    label: str, answers: Sequence[Answer], hit: Callable[[Answer], bool], target: tuple[float, float] | None = None
) -> Share:
    return Share(label, sum(hit(one) for one in answers), len(answers), target)


def detectable(answer: Answer) -> bool:
    """Large enough for a name; one whose size is not known, for want of an answer, counts as such."""
    return answer.detectability is None or answer.detectability >= DETECTABLE


def right_first(answer: Answer) -> bool:
    """The first name is the effect's."""
    return answer.named[:1] == answer.truth[:1]


def tied(answer: Answer) -> bool:
    """Another effect is named first, in a tie with the right one."""
    return not right_first(answer) and any(
        {answer.truth[0], *answer.named[:1], *answer.sensors[:1]} <= set(group) for group in answer.ties
    )


def first_two(answer: Answer) -> bool:
    """The effect is the first or second name, or one of the best two beside the refitted base model."""
    return answer.truth[0] in (*answer.named[:2], *answer.second)


def _both(answer: Answer) -> bool:
    return set(answer.truth) <= set(answer.named)


def _hidden(answer: Answer) -> bool:
    """One of a pair is named and nothing wrong, and what remains is too small for a name."""
    right = bool(answer.named) and set(answer.named) <= set(answer.truth)
    return right and not _both(answer) and answer.remaining is not None and answer.remaining < DETECTABLE


def _wrong(answer: Answer) -> bool:
    return bool(answer.named) and not right_first(answer) and not tied(answer)


def _false_sensor(answer: Answer) -> bool:
    there = {_SENSORS[kind] for kind in answer.nuisances if kind in _SENSORS}
    return not there.issuperset(answer.sensors)


def _noise_only(answer: Answer) -> bool:
    return bool(answer.residuals) and answer.residuals[-1] <= _NOISE_ONLY


def _rises(answer: Answer) -> bool:
    return any(after > _RISE * before for before, after in pairwise(answer.residuals))


def page(answers: Sequence[Answer], title: str) -> Iterator[str]:
    """Lines of Markdown: shares, what was answered to what, and what it cost."""
    yield from (f"# {title}", "", f"{len(answers)} cases.", "")
    yield from (f"- {share}" for share in figures(answers) if share.of)
    yield from ("", "| truth | answered |", "|---|---|")
    rows: dict[str, Counter[str]] = {}
    for one in answers:
        said = " + ".join(one.named) or ("no answer" if one.trouble else "unknown" if one.refuses else "none")
        rows.setdefault(f"{one.kind}: {' + '.join(one.truth) or '-'}", Counter())[said] += 1
    for truth, counts in rows.items():
        yield f"| {truth} | {', '.join(f'{said} {n}' for said, n in counts.most_common())} |"
    yield from ("", "| kind | cases | CPU s: median | 95 % below | longest |", "|---|---|---|---|---|")
    for kind in KINDS:
        costs = [one.cpu for one in _of_kind(answers, kind) if one.cpu]
        if costs:
            middle, most, longest = np.quantile(costs, (0.5, 0.95, 1.0)).tolist()
            yield f"| {kind} | {len(costs)} | {middle:.0f} | {most:.0f} | {longest:.0f} |"
