"""Figures of the learned laws: the shares that are wanted, and a table of every case."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from validation.learned.answer import Answer
from validation.learned.cases import CASES, CONDITIONS
from validation.shares import Share

NEAR = 1.5  # times the noise: what the error may be, the noise itself counted
_RISE = 1.01  # times the error before
_BAND = 0.9  # of the range
_ALIKE = 1e-6  # of the range
_SAME = 0.03  # of the residual, since the answer's floors may be a little above the noise


def shares(answers: Sequence[Answer]) -> Iterator[Share]:
    """What is wanted of the whole table, counted on what was answered."""
    seen = {case.name for case in CASES if case.kind.visible and not case.condition}
    visible = [one for one in answers if one.case in seen]
    unseen = [one for one in answers if one.case in {case.name for case in CASES if not case.kind.visible}]
    asked = [one for one in visible if one.variables is not None]
    bands = [one.band for one in visible if one.band is not None]
    near = sum(one.after is not None and 1 + one.after**2 <= NEAR**2 for one in visible)
    yield Share("right place, of visible laws", sum(one.place for one in visible), len(visible), (90, 100))
    yield Share("right place, by a law or an effect of the catalogue", sum(one.named for one in visible), len(visible))
    yield Share("right variables there", sum(bool(one.variables) for one in asked), len(asked))
    yield Share(f"error at most {NEAR:g} times the noise, of visible laws", near, len(visible), (80, 100))
    yield Share("error higher than before by more than 1 percent", sum(map(_worse, answers)), len(answers), (0, 0))
    hits = sum(band >= _BAND for band in bands)
    yield Share("bands that hold the true curve over nine tenths of its range", hits, len(bands), (90, 100))
    yield Share("a law found where none acts", sum(not one.place for one in unseen), len(unseen), (0, 0))
    exported = [one.exported for one in answers if one.exported is not None]
    yield Share(
        "FMUs of FMI 2 and 3 that differ from what was fitted",
        sum(not d <= _ALIKE for d in exported),
        len(exported),
        (0, 0),
    )
    kept = [one for one in answers if one.exported is not None and one.fitted is not None]
    other = sum(one.again is None or abs(one.again / (one.fitted or 1.0) - 1) > _SAME for one in kept)
    yield Share("learned classes that do not run as what was fitted", other, len(kept), (0, 0))
    took = [one.learning for one in answers if one.learning]
    yield Share("learning within 60 s, of those where it began", sum(s <= 60 for s in took), len(took))
    for condition in CONDITIONS:
        own = [one for one in answers if one.case.endswith(f"-{condition}")]
        yield Share(f"{condition}: right place", sum(one.place for one in own), len(own))
        near = sum(one.after is not None and 1 + one.after**2 <= NEAR**2 for one in own)
        yield Share(f"{condition}: error at most {NEAR:g} times the noise", near, len(own))
    yield Share("cases without an answer", sum(bool(one.trouble) for one in answers), len(answers), (0, 0))


def _worse(one: Answer) -> bool:
    """The noise counts on both sides, so that a change far below it is none; a model that cannot run is worse."""
    if one.trouble or one.before is None:
        return False
    return one.after is None or 1 + one.after**2 > _RISE**2 * (1 + one.before**2)


def page(answers: Sequence[Answer], title: str) -> Iterator[str]:
    """Lines of Markdown: the shares, and a row for each case."""
    yield from (
        f"# {title}",
        "",
        f"{len(answers)} cases. Errors and bands are as in the README beside this folder.",
        "",
    )
    yield from (f"- {share}" for share in shares(answers) if share.of)
    yield from ("", "| case | answered | place | variables | before | after | band | formula | s (of it, learning) |")
    yield "|" + "---|" * 9
    for one in answers:
        found = ", ".join(f"`{words}`" for words in (*one.learned, *one.effects)) or one.trouble or "nothing"
        place = "right" if one.place else "an effect there" if one.named else "**wrong**"
        variables = {True: "right", False: "**wrong**", None: ""}[one.variables]
        errors = ["?" if error is None else f"{error:.2f}" for error in (one.before, one.after)]
        band = "" if one.band is None else f"{100 * one.band:.0f} %"
        formula = f"`{one.formula}`" if one.formula else ""
        seconds = f"{one.seconds:.0f} ({one.learning:.0f})"
        cells = (f"`{one.case}`", found, place, variables, *errors, band, formula, seconds)
        yield f"| {' | '.join(cells)} |"
