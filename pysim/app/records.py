"""One record for the screen: what was measured, what the models say, what they leave over; any window of it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.app.answers import STEPS, Answer
from pysim.io import shown_unit
from pysim.io.prepare.log_names import whole_log
from pysim.present.charts import LOOKS, Chart
from pysim.present.overlay import Line, compared_lines, drawn, overlay_chart, traces
from pysim.types import Dataset, MeasuredRecord, Record

Array = NDArray[np.float64]

MOST = 1600  # points of a line on the screen


@dataclass(frozen=True)
class Overlay:
    """A record with all its lines.

    Args:
        names, units: of its signals.
        models: key of LOOKS and words.
        lines: panel by panel.
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    models: tuple[tuple[str, str], ...]
    lines: tuple[Line, ...]

    @property
    def span(self) -> tuple[float, float]:
        """First and last time, s."""
        return float(min(line.time[0] for line in self.lines)), float(max(line.time[-1] for line in self.lines))

    def samples(self, begin: float, end: float, most: int = MOST) -> tuple[list[Any], list[Any], bool]:
        """Times and values of every line in a window, and whether these are all samples."""
        xs, ys, exact = [], [], True
        for line in self.lines:
            part = window(line.time, begin, end)
            x, y = decimated(line.time[part], line.values[part], most)
            exact = exact and x.size == line.time[part].size
            xs.append(x.tolist())
            ys.append(drawn(y))
        return xs, ys, exact

    def figure(self) -> Chart:
        """The whole record."""
        xs, ys, _ = self.samples(*self.span)
        return overlay_chart(self.names, self.units, self.models, traces(self.lines, list(zip(xs, ys, strict=True))))


def stage_keys(answer: Answer) -> list[tuple[str, str, Mapping[str, Any]]]:
    """Key of LOOKS, words, and stage of the untouched, the refitted and the final model."""
    found = [(step, LOOKS[step].words, answer.stage(step)) for step in STEPS]
    if answer.last["step"] not in STEPS:
        names = dict.fromkeys((*answer.added, answer.last["step"]))
        found.append(("last", f"with {' and '.join(names)}", answer.last))
    return [(key, words, stage) for key, words, stage in found if stage is not None]


def measured_overlay(record: MeasuredRecord, raw: Record | None = None) -> Overlay:
    """A log as it was measured, before anything was compared with it.

    Args:
        raw: before it was prepared; what a step renamed or put in another unit is left out.
    """
    data = record.data
    assert isinstance(data, Record)
    units, scales = _shown(data.units)
    lines = []
    for j, name in enumerate(data.names):
        if raw is not None and (name, data.units[j]) in zip(raw.names, raw.units, strict=True):
            lines.append(Line("raw", "as logged", j + 1, units[j], raw.time, raw[name] * scales[j]))
        lines.append(Line("measured", "measured", j + 1, units[j], data.time, data.values[:, j] * scales[j]))
    return Overlay(data.names, units, (), tuple(lines))


def followed_overlay(found: Mapping[str, Any]) -> Overlay:
    """A log beside the model at some values of its parameters, as `Followed.curves` gives it."""
    units, scales = _shown(found["units"])
    time, words, lines = np.array(found["time"]), "with these values", []
    for k, scale in enumerate(scales):
        measured, simulated, left = (np.array(found[key][k]) for key in ("measured", "simulated", "left"))
        lines.append(Line("measured", "measured", 2 * k + 1, units[k], time, measured * scale))
        lines.append(Line("last", words, 2 * k + 1, units[k], time, simulated * scale))
        lines.append(Line("last", words, 2 * k + 2, "times the noise", time, left))
    return Overlay(tuple(found["names"]), units, (("last", words),), tuple(lines))


def raw_of(raw: Dataset, record: MeasuredRecord) -> Record | None:
    """A log before it was prepared, and before a step cut it into parts."""
    found = next((one.data for one in raw.records if one.source in (record.source, whole_log(record.source))), None)
    return found if isinstance(found, Record) else None


def compared_overlay(answer: Answer, number: int) -> Overlay | None:
    """A log, by its number among those of the data set, beside the models of an answer; None where not compared."""
    sides = [(key, words, _of(stage, number)) for key, words, stage in stage_keys(answer)]
    found = [(key, words, own) for key, words, own in sides if own is not None]
    if not found:
        return None
    array, first = answer.stages.array, found[0][2]
    models = []
    for key, words, own in found:
        simulated, hidden = array(own["simulated"]), own is first and len(found) > 1  # what it leaves would hide theirs
        left = None if hidden else (array(own["measured"]) - simulated) / np.array(own["noise"])
        models.append((key, words, array(own["time"]), simulated, left))
    lines = compared_lines(first["units"], array(first["time"]), array(first["measured"]), models)
    names = tuple((key, words) for key, words, _ in found)
    return Overlay(tuple(first["names"]), _shown(first["units"])[0], names, tuple(lines))


def _of(stage: Mapping[str, Any], number: int) -> Mapping[str, Any] | None:
    return next((record for record in stage["records"] if record["index"] == number), None)


def _shown(units: Sequence[str]) -> tuple[tuple[str, ...], tuple[float, ...]]:
    """Units as people read them, and the factors to them."""
    pairs = [shown_unit(unit) for unit in units]
    return tuple(unit for unit, _ in pairs), tuple(scale for _, scale in pairs)


def window(time: Array, begin: float, end: float) -> slice:
    """Samples from begin to end, s, with one more at either side so that lines reach the edge."""
    first, last = np.searchsorted(time, [begin, end], side="left")
    return slice(max(int(first) - 1, 0), min(int(last) + 2, time.size))


def decimated(time: Array, values: Array, most: int) -> tuple[Array, Array]:
    """At most so many points that look the same: per stretch the smallest and the largest sample, where they were.

    Args:
        time, values: (n,).
        most: of points, at least 4; where there are no more samples than that, all of them come back as they are.
    """
    if time.size <= most:
        return time, values
    stretches = max(most // 2 - 1, 1)
    edges = np.linspace(0, time.size, stretches + 1).astype(np.intp)
    under, over = (np.where(np.isnan(values), end, values) for end in (math.inf, -math.inf))  # an empty cell is neither
    low = np.array([a + int(np.argmin(under[a:b])) for a, b in pairwise(edges.tolist())])
    high = np.array([a + int(np.argmax(over[a:b])) for a, b in pairwise(edges.tolist())])
    kept = np.unique(np.concatenate([[0], low, high, [time.size - 1]]))
    return time[kept], values[kept]
