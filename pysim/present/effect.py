"""An effect's law, drawn."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pysim.effects import Sketch
from pysim.present.style import COLOURS, DASHES, LIMIT, TEXT, new_figure, quiet

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def sketch_figure(sketch: Sketch, name: str) -> Figure:
    """The strokes of a law: its curve, some curves of a family, or a wave and the answer to it.

    Args:
        name: of the effect.
    """
    figure = new_figure(4.6, 3.4)
    axes = figure.subplots()
    axes.axhline(0.0, color=LIMIT, linewidth=0.8)
    for k, (x, y) in enumerate(sketch.curves):
        axes.plot(x, y, color=COLOURS[k % len(COLOURS)], linestyle=DASHES[k % len(DASHES)], linewidth=1.6)
    axes.set_title(f"{name}: {sketch.words}", fontsize=TEXT)
    axes.set_xticks([])
    axes.set_yticks([])
    quiet(axes)
    return figure
