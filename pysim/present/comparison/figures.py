"""The pictures of a comparison."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from pysim.io import shown_value
from pysim.present.comparison.answer import Comparisons
from pysim.present.comparison.bode import bode_figure
from pysim.present.comparison.deviation import deviation_figure
from pysim.present.render import Picture
from pysim.types import Comparison

_ALL = "deviations"


def figures(result: Comparisons) -> Iterator[Picture]:
    """The deviation of every test, and a Bode plot per offset."""
    return (comparison_picture(result.sets, name) for name in picture_names(result.sets))


def picture_names(sets: Sequence[Comparison]) -> list[str]:
    """Of all pictures, in their order."""
    return [_ALL, *_offsets(sets)]


def comparison_picture(sets: Sequence[Comparison], name: str) -> Picture:
    """One of them; drawing is what takes time, so that several processes may share it."""
    if name == _ALL:
        caption = "Deviation of every test, criterion by criterion; hollow: beyond the limit."
        return Picture(name, caption, deviation_figure(sets))
    offset, first = _offsets(sets)[name], sets[0]
    around = shown_value(offset, first.command_unit)
    caption = f"Offset {around}: {first.measured_name}, and simulated; grey: what is allowed."
    return Picture(name, caption, bode_figure(sets, offset))


def _offsets(sets: Sequence[Comparison]) -> dict[str, float]:
    """Name of a Bode plot -> offset of its tests."""
    return {f"bode_O{offset:+g}": offset for offset in sorted({test.measured.test.offset for test in sets[0].tests})}
