"""Figure 4.9: the ripple before and after a hose, by the case `ripple`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from matplotlib.figure import Figure

from validation.findings import Finding
from validation.ripple import hose
from validation.ripple.pictures import hose_picture


def notes() -> Sequence[str]:
    """What was not published."""
    return (NOTE,)


def run() -> Iterator[Finding]:
    """What `ripple` finds of it."""
    yield from hose.findings()


def pictures() -> Mapping[str, Figure]:
    """As in the thesis, with what decides beside it."""
    return {"Figure 4.9 redone: flow before and after the hose; right: the share that arrives.": hose_picture()}


NOTE = (
    "The thesis has the ripple gone behind the hose. It gives neither the wall, nor its damping, nor the segments of "
    "its model: one to four segments say so whatever the hose. With 32 a quarter of the ripple arrives."
)
