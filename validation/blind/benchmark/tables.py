"""The benchmark's tables as Markdown."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from validation.blind.benchmark.figures import DETECTABLE, Figure, Pair, right_first, tied
from validation.blind.plant.effects import BEYOND, SIZES, STANDARD
from validation.blind.plant.table import NOISES

_LEFT_OUT = "left out of the catalogue"


def figure_table(figures: Iterable[Figure]) -> Iterator[str]:
    """Count, share, interval, target, and whether it is met."""
    yield "| figure | count | share | 95 % interval | target | met |"
    yield "|---|---|---|---|---|---|"
    for f in figures:
        share = f"{f.percent:.1f} %" if f.of else "-"
        interval = "{:.1f} to {:.1f} %".format(*f.interval) if f.of else "-"
        met = "" if f.target is None else "too few" if f.of < f.least else "**no**" if f.beyond else "yes"
        yield f"| {f.label} | {f.hits} of {f.of} | {share} | {interval} | {f.words} | {met} |"


def sizes(pairs: Sequence[Pair]) -> Iterator[str]:
    """Effect by size and noise: u for right with the spool logged, a from the angle alone; least detectability."""
    named = [pair for pair in pairs if pair[0].kind == "named"]
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
    known = [answer.detectability for _, answer in named if answer.detectability is not None]
    small = sum(value < DETECTABLE for value in known)
    yield ""
    yield (
        "`u` is right with the spool logged, `a` right from the angle alone, `=` tied with the right one, `-` not "
        "named; the number is the smaller of the two detectabilities. It is below "
        f"{DETECTABLE:g} in {small} of {len(known)} cases."
    )


def _cell(pairs: Sequence[Pair]) -> str:
    if not pairs:
        return ""
    words = []
    for spool, letter in ((True, "u"), (False, "a")):
        own = [pair for pair in pairs if pair[0].spool == spool]
        if own:
            words.append(letter if right_first(own[0]) else "=" if tied(own[0]) else "-")
    known = [answer.detectability for _, answer in pairs if answer.detectability is not None]
    return f"{''.join(words)} {min(known):.2g}" if known else "".join(words)


def confusion(pairs: Sequence[Pair]) -> Iterator[str]:
    """Truth down, verdict across; effects left out of the catalogue in one row, pairs apart."""
    found: dict[str, Counter[str]] = {name: Counter() for name in (*STANDARD, "none", _LEFT_OUT, *BEYOND)}
    for case, answer in pairs:
        if case.kind != "pair":
            truth = _LEFT_OUT if case.kind == "left-out" else case.effects[0][0] if case.effects else "none"
            found[truth][answer.verdict or "no answer"] += 1
    rows = {truth: row for truth, row in found.items() if row}
    given = [name for name in (*STANDARD, "unknown", "none", "no answer") if any(row[name] for row in rows.values())]
    yield f"| in the plant | {' | '.join(given)} |"
    yield "|---" * (len(given) + 1) + "|"
    for truth, row in rows.items():
        yield f"| {truth} | {' | '.join(str(row[name] or '') for name in given)} |"


def misses(pairs: Sequence[Pair]) -> Iterator[str]:
    """Which parameters' intervals missed the truth, the most frequent first."""
    rows = [answer for case, answer in pairs if case.kind == "named" and answer.determined]
    counts = Counter(name for answer in rows for name in answer.missed)
    listed = ", ".join(f"{name} {n}" for name, n in counts.most_common(12)) or "none"
    yield f"Intervals that missed the truth, in {len(rows)} cases rightly repaired: {listed}."


def times(pairs: Sequence[Pair]) -> Iterator[str]:
    """Wall and processor time of a diagnosis by kind."""
    yield "| kind | cases | wall time: median | 95 % below | longest | processor time: median |"
    yield "|---|---|---|---|---|---|"
    for kind in dict.fromkeys(case.kind for case, _ in pairs):
        rows = [answer for case, answer in pairs if case.kind == kind and answer.wall > 0]
        if rows:
            middle, most, longest = np.quantile([a.wall for a in rows], (0.5, 0.95, 1.0)).tolist()
            work = float(np.median([a.cpu for a in rows]))
            yield f"| {kind} | {len(rows)} | {middle:.0f} s | {most:.0f} s | {longest:.0f} s | {work:.0f} s |"
