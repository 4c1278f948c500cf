"""Figure 4.11: a relief valve shaken by the ripple, by the case `ripple`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from matplotlib.figure import Figure

from validation.findings import Finding
from validation.ripple import relief
from validation.ripple.pictures import relief_picture


def notes() -> Sequence[str]:
    """What was not published."""
    return (NOTE,)


def run() -> Iterator[Finding]:
    """What `ripple` finds of it."""
    yield from relief.findings()


def pictures() -> Mapping[str, Figure]:
    """As in the thesis, with what decides beside it."""
    return {
        "Figure 4.11 redone: a relief valve with ripple and without; right: swing over its frequency.": relief_picture()
    }


NOTE = (
    "The valve's data were not published: damping is the one that responds most, mean opening that of the figure. So "
    "the study shows that a valve can be shaken by the ripple, not that the thesis' valve would be."
)
