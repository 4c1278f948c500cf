"""The ripple behind a hose and at a relief valve, each against a calculation without the FMU."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from matplotlib.figure import Figure

from validation.findings import Finding
from validation.ripple import hose, relief
from validation.ripple.pictures import cause_picture, hose_picture, relief_picture


def run() -> Iterator[Finding]:
    """The hose of Fig. 4.9, then the valve of Fig. 4.11."""
    yield from hose.findings()
    yield from relief.findings()


def pictures() -> Mapping[str, Figure]:
    """Both figures as in the thesis, with what decides beside them."""
    return {
        "Figure 4.9 redone: flow before and after the hose; right: the share that arrives.": hose_picture(),
        "What could take the ripple away, as strong as it may be; orange: nothing to be seen.": cause_picture(),
        "Figure 4.11 redone: a relief valve with ripple and without; right: its swing.": relief_picture(),
    }


def notes() -> Sequence[str]:
    """What was not published."""
    return (
        "The thesis has the ripple gone behind the hose. It gives neither the wall, nor its damping, nor the segments "
        "of its model: one to four segments say so whatever the hose. With 32 a quarter of the ripple arrives.",
        "The relief valve's data were not published: damping is the one that responds most, mean opening that of the "
        "figure. So the study shows that a valve can be shaken by the ripple, not that the thesis' valve would be.",
    )
