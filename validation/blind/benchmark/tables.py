"""The benchmark's tables as Markdown."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from validation.blind.benchmark.figures import VISIBLE, Figure, Pair, right_first, tied
from validation.blind.benchmark.kept import Kept
from validation.blind.benchmark.logistic import rise
from validation.blind.benchmark.pictures import confusion
from validation.blind.benchmark.slots import SLOTS
from validation.blind.plant.effects import SIZES, STANDARD
from validation.blind.plant.table import NOISES

_MARKS = {None: "", True: "yes", False: "**no**"}


def figure_table(figures: Iterable[Figure]) -> Iterator[str]:
    """Count, share, interval, target, and whether it is met."""
    yield "| figure | count | share | 95 % interval | target | met |"
    yield "|---|---|---|---|---|---|"
    for f in figures:
        share = f"{f.percent:.1f} %" if f.of else "-"
        interval = "{:.1f} to {:.1f} %".format(*f.interval) if f.of else "-"
        label = f"{f.label} ({f.note})" if f.note else f.label
        yield f"| {label} | {f.hits} of {f.of} | {share} | {interval} | {f.words} | {_MARKS[f.holds]} |"


def provenance(answered: Sequence[Pair], asked: int, kept: Kept) -> Iterator[str]:
    """How many, when, and by which code; why older ones count, and how many do not."""
    yield f"- {len(answered)} of {asked} cases answered."
    groups: dict[str, list[str]] = {}
    for _, answer in answered:
        groups.setdefault(answer.code, []).append(answer.day)
    for code, days in sorted(groups.items(), key=lambda item: -len(item[1])):
        span = min(days) if min(days) == max(days) else f"{min(days)} to {max(days)}"
        yield f"- Code `{code}`: {len(days)} cases, {span}."
    for step in kept.carried:
        but = f", but for {' and '.join(f'`{name}`' for name in step.but)}" if step.but else ""
        both = " by both codes on one computer" if step.anew else ""
        yield (
            f"- Code `{step.newer}` answers as `{step.older}` did{but}: {len(step.cases)} cases, drawn with seed "
            f"{step.seed}, were answered again{both} on {step.day}, and no field differed; at most "
            f"{100 * (1 - 0.05 ** (1 / len(step.cases))):.0f} % of all could, with 95 % confidence."
        )
    if kept.stale:
        yield f"- {kept.stale} stored answers of other code are not counted."


def cost(answered: Sequence[Pair]) -> Iterator[str]:
    """Wall and processor time of a diagnosis by kind."""
    yield "| kind | cases | wall time: median | 95 % below | longest | processor time: median |"
    yield "|---|---|---|---|---|---|"
    for kind in dict.fromkeys(case.kind for case, _ in answered):
        rows = [answer for case, answer in answered if case.kind == kind and answer.wall > 0]
        if rows:
            middle, most, longest = np.quantile([a.wall for a in rows], (0.5, 0.95, 1.0)).tolist()
            work = float(np.median([a.cpu for a in rows]))
            yield f"| {kind} | {len(rows)} | {middle:.0f} s | {most:.0f} s | {longest:.0f} s | {work:.0f} s |"


def sizes(named: Sequence[Pair]) -> Iterator[str]:
    """Effect by size and noise: u for right with the spool logged, a from the angle alone; smallest footprint."""
    head = [f"{size} {noise:g} %" for size in SIZES for noise in NOISES]
    yield f"| effect | {' | '.join(head)} |"
    yield "|---" * (len(head) + 1) + "|"
    for effect in STANDARD:
        cells = []
        for size in SIZES:
            for noise in NOISES:
                here = [p for p in named if p[0].effects == ((effect, size),) and p[0].noise == noise]
                cells.append(_cell(here))
        if any(cells):
            yield f"| {effect} | {' | '.join(cells)} |"


def _cell(pairs: Sequence[Pair]) -> str:
    if not pairs:
        return ""
    words = []
    for spool, letter in ((True, "u"), (False, "a")):
        own = [pair for pair in pairs if pair[0].spool == spool]
        if own:
            words.append(letter if right_first(own[0]) else "=" if tied(own[0]) else "-")
    known = [answer.footprint for _, answer in pairs if answer.footprint is not None]
    return f"{''.join(words)} {min(known):.2g}" if known else "".join(words)


def impossible(named: Sequence[Pair]) -> Iterator[str]:
    """The footprints at which half and 95 percent are named, and the cases that are too small."""
    known = [pair for pair in named if pair[1].footprint]
    if not known:
        return
    found = rise(
        np.log10([max(pair[1].footprint or 0.0, 1.0) for pair in known]), np.array([right_first(p) for p in known])
    )
    half, most = 10 ** found.where(0.5), 10 ** found.where(0.95)
    yield f"By the logistic curve half of the effects are named at a footprint of {half:.3g}, 95 percent at {most:.3g}."
    small = [case for case, answer in known if (answer.footprint or 0.0) < VISIBLE]
    counts = Counter((case.effects[0], case.noise) for case in small)
    cells = [f"{n} {size} at {noise:g} %" for ((n, size), noise), _ in sorted(counts.items())]
    yield f"Below {VISIBLE:g} are {len(small)} of {len(known)} cases{': ' if cells else ''}{', '.join(cells)}."


def confusion_table(answered: Sequence[Pair]) -> Iterator[str]:
    """Truth down, verdict across; columns that nobody was given are left out."""
    found = confusion(answered)
    given = [name for name in (*STANDARD, "unknown", "none", "no answer") if any(row[name] for row in found.values())]
    yield f"| in the plant | {' | '.join(given)} |"
    yield "|---" * (len(given) + 1) + "|"
    for truth, row in found.items():
        yield f"| {truth} | {' | '.join(str(row[name] or '') for name in given)} |"


def misses(answered: Sequence[Pair]) -> Iterator[str]:
    """Which parameters' intervals missed the truth, the most frequent first."""
    rows = [answer for case, answer in answered if case.kind == "named" and answer.determined]
    counts = Counter(name for answer in rows for name in answer.missed)
    if counts:
        told = ", ".join(f"{name} {n}" for name, n in counts.most_common(12))
        yield f"Intervals that missed the truth, in {len(rows)} cases rightly repaired: {told}."


def places(located: Sequence[Pair]) -> Iterator[str]:
    """Per effect how often its slot came first or tied, how far its band held the true term, and what came first."""
    yield "| effect | cases | first | tied | band holds, mean share of the range | first instead |"
    yield "|---|---|---|---|---|---|"
    for effect in STANDARD:
        rows = [answer for case, answer in located if case.effects[0][0] == effect]
        covers = [answer.cover for answer in rows if answer.cover is not None]
        wrong = Counter(answer.slot or "nothing" for answer in rows if answer.rank != 1)
        tied = sum(answer.rank > 1 and SLOTS[effect] in answer.alike for answer in rows)
        held = f"{100 * float(np.mean(covers)):.0f} % of {len(covers)}" if covers else "-"
        other = ", ".join(f"{slot} {n}" for slot, n in wrong.most_common())
        if rows:
            yield f"| {effect} | {len(rows)} | {sum(a.rank == 1 for a in rows)} | {tied} | {held} | {other} |"


def ties(followed: Sequence[Pair]) -> Iterator[str]:
    """Case by case: who was tied, and what the diagnosis says with the next test."""
    rows = [(case, answer) for case, answer in followed if answer.rivals]
    yield f"{len(rows)} of {len(followed)} cases that were followed ended in a tie with a next test."
    if rows:
        yield ""
        yield "| case | tied | with the next test |"
        yield "|---|---|---|"
    for case, answer in rows:
        after = answer.after if answer.settled else f"{answer.after}, not settled"
        yield f"| {case.name} | {', '.join(answer.rivals)} | {after} |"
