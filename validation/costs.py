"""Costs over time: every kept run's measured costs beside the other side of the same run."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from datetime import datetime

from matplotlib.axes import Axes
from matplotlib.dates import DateFormatter, date2num
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, MaxNLocator, NullLocator, StrMethodFormatter

from pysim.plot.style import COLOURS, MARKERS, SMALL, legend_above, new_figure, quiet
from validation.findings import Cost
from validation.results import CaseResult

OURS = "ours"
_COLUMNS = 3
_MARGIN = 1.5  # days on either side


@dataclass(frozen=True)
class Point:
    """One measured cost, when and where."""

    cost: Cost
    case: str
    date: str
    machine: str


def points(results: Iterable[CaseResult]) -> list[Point]:
    """Oldest first."""
    return [
        Point(finding.cost, result.case, result.date, str(result.machine))
        for result in sorted(results, key=lambda result: result.date)
        for finding in result.findings
        if finding.cost is not None
    ]


def newest_costs(results: Iterable[CaseResult]) -> list[Point]:
    """The last of each thing and other side, in the order in which they were first measured."""
    return list({(point.cost.what, point.cost.peer): point for point in points(results)}.values())


def cost_rows(results: Iterable[CaseResult]) -> list[list[str]]:
    """What, ours, unit, the other side and its figure, how many times ours that is, case, date."""
    rows = []
    for point in newest_costs(results):
        cost = point.cost
        row = [cost.what, f"{cost.ours:.3g}", cost.unit]
        row += (
            ["", "", ""] if cost.theirs is None else [cost.peer, f"{cost.theirs:.3g}", f"{cost.theirs / cost.ours:.2g}"]
        )
        rows.append([*row, point.case, point.date[:10]])
    return rows


HEAD = ("what", "ours", "unit", "other side", "theirs", "times ours", "case", "date")


def cost_figure(results: Iterable[CaseResult]) -> Figure | None:
    """A panel per thing, with a line per side; another machine begins a new line. None where nothing was measured."""
    found = points(results)
    if not found:
        return None
    things = list(dict.fromkeys(point.cost.what for point in found))
    sides = [OURS, *dict.fromkeys(point.cost.peer for point in found if point.cost.theirs is not None)]
    days = [_day(point.date) for point in found]
    span = min(days) - _MARGIN, max(days) + _MARGIN
    rows = -(-len(things) // _COLUMNS)
    figure = new_figure(9.0, 0.6 + 2.0 * rows)
    panels = figure.subplots(rows, min(_COLUMNS, len(things)), squeeze=False).ravel()
    for panel, what in zip(panels, things, strict=False):
        _panel(panel, what, [point for point in found if point.cost.what == what], sides, span)
    for panel in panels[len(things) :]:
        panel.set_axis_off()
    looks = [panels[0].plot([], [], **_look(k))[0] for k in range(len(sides))]
    legend_above(figure, looks, sides)
    return figure


def _look(side: int) -> dict[str, object]:
    colour = COLOURS[side % len(COLOURS)]
    face = colour if side == 0 else "white"
    return {"color": colour, "marker": MARKERS[side % len(MARKERS)], "markerfacecolor": face, "markersize": 4.5}


def _panel(panel: Axes, what: str, found: Sequence[Point], sides: Sequence[str], span: tuple[float, float]) -> None:
    quiet(panel)
    for machine in dict.fromkeys(point.machine for point in found):
        for k, side in enumerate(sides):
            line = {
                point.date: point.cost.ours if side == OURS else point.cost.theirs
                for point in found
                if point.machine == machine and side in (OURS, point.cost.peer)
            }
            values = [value for value in line.values() if value is not None]
            if values:
                panel.plot([_day(date) for date in line], values, linewidth=1.0, **_look(k))  # type: ignore[arg-type]
    values = [v for point in found for v in (point.cost.ours, point.cost.theirs) if v is not None]
    panel.set_yscale("log")
    panel.set_ylim(min(values) / 1.8, 1.8 * max(values))
    panel.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    panel.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    panel.yaxis.set_minor_locator(NullLocator())
    panel.set_xlim(*span)
    panel.xaxis.set_major_locator(MaxNLocator(3, integer=True))
    panel.xaxis.set_major_formatter(DateFormatter("%Y-%m-%d"))
    panel.set_title(what, fontsize=SMALL)
    panel.set_ylabel(found[-1].cost.unit, fontsize=SMALL)


def _day(date: str) -> float:
    return float(date2num(datetime.fromisoformat(date.replace("Z", "+00:00"))))
