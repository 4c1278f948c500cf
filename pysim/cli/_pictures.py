"""The pictures of a comparison, as PNG files and for the report."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from pysim.types import Comparison


def write_pictures(
    comparisons: Sequence[Comparison], folder: Path, executor: Executor | None = None
) -> dict[str, bytes]:
    """Write deviations.png and a Bode plot per offset; return caption -> SVG for the report.

    Args:
        executor: draws several at a time.
    """
    draw = partial(draw_picture, tuple(comparisons), folder)
    names = list(_figures(comparisons))
    drawn = executor.map(draw, names) if executor else map(draw, names)
    return {_figures(comparisons)[name][0]: svg for name, svg in zip(names, drawn, strict=True)}


def draw_picture(comparisons: Sequence[Comparison], folder: Path, name: str) -> bytes:
    """Write one of the pictures as a PNG file; return it as SVG."""
    from pysim.io import write_file
    from pysim.plot import bode_figure, deviation_figure, render

    _, at = _figures(comparisons)[name]
    figure = deviation_figure(comparisons) if at is None else bode_figure(comparisons, at)
    write_file(folder / name, render(figure, "png"))
    figure.set_layout_engine("none")  # what the first drawing found is good for the second, and costs as much
    return render(figure, "svg")


def _figures(comparisons: Sequence[Comparison]) -> dict[str, tuple[str, float | None]]:
    """File name -> caption, and the offset of a Bode plot."""
    from pysim.io import shown_value

    figures: dict[str, tuple[str, float | None]] = {
        "deviations.png": ("Deviation of every test, criterion by criterion; hollow: beyond the limit.", None)
    }
    first = comparisons[0]
    for offset in sorted({test.measured.test.offset for test in first.tests}):
        around = shown_value(offset, first.command_unit)
        caption = f"Offset {around}: {first.measured_name}, and simulated; grey: what is allowed."
        figures[f"bode_O{offset:+g}.png"] = (caption, offset)
    return figures
