"""What each candidate explains of the misfit."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pysim.present import style
from pysim.present.diagnosis.words import called, candidates_shown
from pysim.types import BadInput, Diagnosis, Rival

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_ROWS = 14  # candidates shown


def candidates_figure(diagnosis: Diagnosis) -> Figure:
    """Share of the misfit that each candidate explains, the best on top: full bars are refitted, hollow ones estimated.

    What was added, and what these data cannot tell from it, have colours of their own.

    Raises:
        BadInput: no candidate.
    """
    rows = candidates_shown(diagnosis)[:_ROWS]
    if not rows:
        raise BadInput("candidates figure: needs at least one candidate")
    added, tied = {one.effect.name for one in diagnosis.effects}, {name for group in diagnosis.ties for name in group}
    figure, ((axes,),) = style.panels(7.4, 0.9 + 0.27 * len(rows))
    axes.grid(False, axis="y")
    for i, row in enumerate(rows):
        last = row.effects[-1]
        _bar(axes, i, row, style.COLOURS[4 if last in tied else 0 if last in added else 5])
    axes.set_xlim(0, 120)
    axes.set_xticks(range(0, 101, 20))
    axes.set_ylim(len(rows) - 0.4, -0.6)
    axes.set_yticks(range(len(rows)), [called(*row.effects) for row in rows], fontsize=style.SMALL)
    axes.set_xlabel("Explains of the misfit of the model it joins (%)")
    from matplotlib.patches import Patch

    kinds = {"added": Patch(facecolor=style.COLOURS[0])} if added - tied else {}
    kinds |= {"indistinguishable": Patch(facecolor=style.COLOURS[4])} if tied else {}
    kinds |= {"refitted": Patch(facecolor=style.COLOURS[5])}
    kinds |= {"estimated": Patch(facecolor="white", edgecolor=style.COLOURS[5], hatch="////")}
    style.legend_above(figure, list(kinds.values()), list(kinds))
    return figure


def _bar(axes: Axes, i: int, row: Rival, colour: str) -> None:
    hollow = {"facecolor": "white", "edgecolor": colour, "hatch": "////"}
    look: dict[str, Any] = {"facecolor": colour} if row.refitted else hollow
    share = 100 * row.explained
    axes.barh(i, share, height=0.62, linewidth=0.8, **look)
    text = f"{share:.1f} %" if row.score > 0 else f"{share:.1f} %, no better for its parameters"
    style.small_text(axes, text, (share, i), (4, 0), va="center", color="#333333")
