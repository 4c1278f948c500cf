"""The pictures of a comparison, drawn by several processes at a time."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from pysim.present import Drawing
    from pysim.types import Comparison


def write_pictures(comparisons: Sequence[Comparison], folder: Path, executor: Executor) -> list[Drawing]:
    """Write deviations and a Bode plot per offset."""
    from pysim.present.comparison import picture_names

    return list(executor.map(partial(draw_picture, tuple(comparisons), folder), picture_names(comparisons)))


def draw_picture(comparisons: Sequence[Comparison], folder: Path, name: str) -> Drawing:
    """Write one of the pictures."""
    from pysim.present.comparison import comparison_picture
    from pysim.present.render import draw

    return draw(comparison_picture(comparisons, name), folder)
