"""Best linear approximations, shown: text, JSON, figure and page."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.identify.multisine import distortion_p_value, gain_interval, gain_radius, pooled
from pysim.io import shown_value
from pysim.present.page import heading, items, paragraph, pictures, table
from pysim.present.page import page as whole_page
from pysim.present.plain_text import aligned
from pysim.present.render import Drawing, Picture
from pysim.present.style import COLOURS, LIMIT, MEASURED, TEXT, frequency_axis, legend_above, panels, phase_axis
from pysim.types import BestLinearApproximation, Distortion, Level
from pysim.types.json_number import json_data

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

_ROWS = 12  # frequencies in a table; all of them are in the data
_ALARM = 0.01  # p-value below which a distortion counts as seen
_POOL = 6  # free lines whose mean stands in a table, and is drawn through the single ones
_SURE_DEG = 45.0  # phases less sure than this do not widen the axis
_NEARLY_NONE = 0.05
_BELOW_NOISE_DB = 6.0  # how far under the lowest noise the axis reaches
_HEADS = ("Hz", "gain dB", "± dB", "phase deg", "± deg", "noise dB", "distortion dB", "even dB", "odd dB")


@dataclass(frozen=True)
class Approximations:
    """Those of one data set, or of some records.

    Args:
        title: of the page.
        found: what each was found from, and what was found.
    """

    title: str
    found: tuple[tuple[str, BestLinearApproximation], ...]


def named(found: Iterable[BestLinearApproximation]) -> tuple[tuple[str, BestLinearApproximation], ...]:
    """Each with its test in words, and behind them its origin where another is of the same test."""
    names: dict[str, BestLinearApproximation] = {}
    for bla in found:
        test = bla.test
        offset, rms = shown_value(test.offset, test.input_unit, ".4g"), shown_value(test.rms, test.input_unit, ".3g")
        name = f"{test.input} around {offset}, rms {rms}"
        names[f"{name}, {bla.origin}" if name in names else name] = bla
    return tuple(names.items())


def text(result: Approximations) -> str:
    """Of each the verdicts, then some of the lines; "-" is below what the noise lets see."""
    return "\n\n".join(_text(name, bla) for name, bla in result.found)


def data(result: Approximations) -> dict[str, Any]:
    """Everything, numbers finite or None: gain unit is output per input unit, levels are variances in its square."""
    return json_data({"approximations": [_data(name, bla) for name, bla in result.found]})


def figures(result: Approximations) -> Iterator[Picture]:
    """One per approximation."""
    for i, (name, bla) in enumerate(result.found, start=1):
        caption = f"{name}: gain with its 95 percent band, and the levels beside it; points are single lines."
        yield Picture(f"multisine_{i}", caption, multisine_figure(bla, name))


def page(result: Approximations, drawings: Sequence[Drawing], redo: str) -> str:
    """Verdicts, pictures and a table per approximation."""
    parts = [heading("Best linear approximation")]
    for name, bla in result.found:
        parts += [paragraph(f"{name}, {bla.method}."), items(verdicts(bla))]
    parts += pictures(drawings)
    parts.append(
        paragraph(
            "Levels are mean squares of one realisation over its periods, divided by the input's power on a line; they "
            "add up. Even and odd parts are means over neighbouring lines that were not excited. A dash is below what "
            "the noise lets see.",
            note=True,
        )
    )
    for name, bla in result.found:
        caption = f"{name}: some of {bla.frequency.size} lines, ± for 95 percent"
        parts.append(table(caption, _heads(bla), _rows(bla)))
    lead = "How much of the response is linear, how much noise, how much distortion, line by line."
    return whole_page(result.title, lead, parts, redo)


def _text(name: str, bla: BestLinearApproximation) -> str:
    lines = (*verdicts(bla), *aligned([_heads(bla), *_rows(bla)]))
    return "\n".join([f"{name}: {bla.method}", *(f"  {line}" for line in lines)])


def verdicts(bla: BestLinearApproximation) -> tuple[str, ...]:
    """What the numbers say, a sentence each."""
    test = bla.test
    done = (
        f"{test.realisations} realisation(s) of {test.periods} period(s) of {test.period:g} s, {bla.frequency.size} "
        f"lines from {bla.frequency[0]:g} to {bla.frequency[-1]:g} Hz; {test.input} around "
        f"{shown_value(test.offset, test.input_unit, '.4g')} with {shown_value(test.rms, test.input_unit, '.4g')} rms"
    )
    if bla.on_lines is None or bla.noise is None:
        return (done, "Without a second period noise and distortion cannot be separated.")
    found = [_verdict(words, level) for words, level in (("even", bla.even), ("odd", bla.odd)) if level is not None]
    if bla.odd is None:
        found.append(_verdict("on the excited lines, even and odd together,", bla.on_lines))
    return (done, *found, _worst(bla))


def _data(name: str, bla: BestLinearApproximation) -> dict[str, Any]:
    test = bla.test
    interval, (phase, half) = gain_interval(bla)[0], _phase(bla)
    levels = {key: getattr(bla, key) for key in ("total", "noise", "distortion", "on_lines", "even", "odd")}
    return {
        "name": name,
        "method": bla.method,
        "origin": bla.origin,
        "test": {key: getattr(test, key) for key in test.__dataclass_fields__},
        "frequency_hz": bla.frequency,
        "gain_real": bla.gain.real,
        "gain_imag": bla.gain.imag,
        "gain": np.abs(bla.gain),
        "gain_half_width_95": interval,
        "phase_deg": phase,
        "phase_half_width_95_deg": half,
        "variance": bla.variance,
        "degrees_of_freedom": bla.degrees,
        "noise_variance": bla.noise_variance,
        "input_amplitude": bla.amplitude,
        "output_mean": bla.mean,
        "output_mean_variance": bla.mean_variance,
        "levels": {key: None if level is None else _level_data(level) for key, level in levels.items()},
    }


def _verdict(words: str, level: Distortion) -> str:
    p = distortion_p_value(level)
    chance = "p < 1e-6" if p < 1e-6 else f"p = {p:.2g}"
    if p < _ALARM:
        mean = 10 * np.log10(max(float(np.mean(level.variance)), 1e-300))
        above = 10 * np.log10(float(np.mean(level.power) / max(float(np.mean(level.noise)), 1e-300)))
        return f"Distortion {words} is there ({chance}): {mean:.1f} dB on average, {above:.1f} dB above the noise"
    return f"Distortion {words} is not seen ({chance}); it would have to stand out of the noise"


def _worst(bla: BestLinearApproximation) -> str:
    """Where the linear picture is worst, of lines whose distortion stands out, if there is any: of forty lines of a
    linear system one does by chance."""
    if bla.distortion is None:
        return ""
    parts = [level for level in (bla.even, bla.odd or bla.on_lines) if level is not None]
    seen = any(distortion_p_value(level) < _ALARM for level in parts)
    share = np.where(bla.distortion.low > 0, bla.distortion.variance / np.abs(bla.gain) ** 2, 0.0)
    k = int(np.argmax(share))
    if not (seen and share[k] > 0):
        return "No single line's distortion stands out of its noise"
    return f"Worst at {bla.frequency[k]:g} Hz: distortion {-10 * np.log10(share[k]):.1f} dB below the linear response"


def _heads(bla: BestLinearApproximation) -> tuple[str, ...]:
    """Of the table; noise stands for everything where nothing tells it from distortion."""
    return tuple("noise + distortion dB" if bla.noise is None and head == "noise dB" else head for head in _HEADS)


def _rows(bla: BestLinearApproximation) -> list[tuple[str, ...]]:
    """Some of the lines, in words, as `_heads` names the columns."""
    f = bla.frequency
    wanted = np.geomspace(f[0], f[-1], min(_ROWS, f.size))
    at = np.unique(np.argmin(np.abs(np.log(f[:, None] / wanted)), axis=0))
    size, interval, (phase, half) = np.abs(bla.gain), gain_interval(bla)[0], _phase(bla)
    columns = [
        [f"{x:g}" for x in f[at]],
        [f"{x:.2f}" for x in 20 * np.log10(size[at])],
        [f"{x:.2f}" for x in 20 / np.log(10) * interval[at] / size[at]],
        [f"{x:.1f}" for x in phase[at]],
        [f"{x:.1f}" for x in half[at]],
        _decibels(bla.noise or bla.total, at),
        _decibels(bla.distortion, at),
        *(_decibels(None if level is None else pooled(level, f[at], _POOL), None) for level in (bla.even, bla.odd)),
    ]
    return list(zip(*(column or ["-"] * at.size for column in columns), strict=True))


def _decibels(level: Level | None, at: NDArray[np.intp] | None) -> list[str]:
    """Of the lines at these positions, or of all; "-" where the estimate or its lower end is not above zero."""
    if level is None:
        return []
    variance, low = (x if at is None else x[at] for x in (level.variance, level.low))
    return [f"{10 * np.log10(v):.1f}" if v > 0 and e > 0 else "-" for v, e in zip(variance, low, strict=True)]


def _level_data(level: Level) -> dict[str, Any]:
    found = {"frequency_hz": level.frequency, "variance": level.variance, "low_95": level.low, "high_95": level.high}
    if not isinstance(level, Distortion):
        return found
    return {**found, "power": level.power, "noise": level.noise, "p_value": distortion_p_value(level)}


def multisine_figure(bla: BestLinearApproximation, title: str) -> Figure:
    """Magnitude and levels (dB) above the phase (deg) over frequency.

    Points are single lines, curves means over neighbouring ones; a level below what the noise lets see is not drawn.
    """
    figure, ((top,), (bottom,)) = panels(8.0, 6.4, 2, sharex=True, height_ratios=(2.2, 1))
    handles: dict[str, Any] = {}
    _draw_levels(top, bla, handles)
    _draw_gain(top, bottom, bla, handles)
    top.set_title(title, fontsize=TEXT)
    top.set(ylabel=f"Gain and levels (dB re 1{_gain_unit(bla)})", ylim=(_floor(bla), None))
    frequency_axis(bottom, bla.frequency[0], bla.frequency[-1])
    phase_axis(bottom)
    bottom.set(xlabel="Frequency (Hz)", ylabel="Phase (deg)", ylim=_phase_range(bla))
    legend_above(figure, list(handles.values()), list(handles))
    return figure


def _draw_gain(top: Axes, bottom: Axes, bla: BestLinearApproximation, handles: dict[str, Any]) -> None:
    f, radius = bla.frequency, gain_radius(bla)
    size = np.abs(bla.gain)
    low, high = 20 * np.log10(np.maximum(size - radius, 1e-3 * size)), 20 * np.log10(size + radius)
    band = top.fill_between(f, low, high, color=COLOURS[2], alpha=0.3, linewidth=0)
    (line,) = top.plot(f, 20 * np.log10(size), color=COLOURS[2], linewidth=1.8)
    phase, half = _phase(bla)
    bottom.fill_between(f, phase - half, phase + half, color=COLOURS[2], alpha=0.3, linewidth=0)
    bottom.plot(f, phase, color=COLOURS[2], linewidth=1.8)
    handles.setdefault("best linear approximation", line)
    handles.setdefault("95 %", band)


def _phase(bla: BestLinearApproximation) -> tuple[Array, Array]:
    """Continuous phase and the half width of its interval, (n_f,) deg."""
    return np.degrees(np.unwrap(np.angle(bla.gain))), np.degrees(gain_interval(bla)[1])


def _phase_range(bla: BestLinearApproximation) -> tuple[float, float]:
    """Ends of the phase axis: what is known at all, with its intervals."""
    phase, half = _phase(bla)
    sure = half < _SURE_DEG if np.any(half < _SURE_DEG) else np.full(half.size, True)
    low, high = float(np.min((phase - half)[sure])), float(np.max((phase + half)[sure]))
    margin = 0.05 * (high - low) + 1.0
    return low - margin, high + margin


def _draw_levels(axes: Axes, bla: BestLinearApproximation, handles: dict[str, Any]) -> None:
    noise, name = (bla.total, "noise and distortion") if bla.noise is None else (bla.noise, "noise")
    if noise is not None:
        (line,) = axes.plot(noise.frequency, _db(noise.variance), color=LIMIT, linewidth=1.2)
        handles.setdefault(name, line)
    if bla.distortion is not None:
        handles.setdefault("distortion", _curve(axes, bla.distortion, MEASURED, "-"))
    for name, level, colour, marker in (
        ("even part", bla.even, COLOURS[1], "s"),
        ("odd part", bla.odd, COLOURS[0], "o"),
    ):
        if level is None:
            continue
        axes.plot(level.frequency, _db(level.variance), color=colour, linestyle="", marker=marker, markersize=2.6)
        f = bla.frequency[(bla.frequency >= level.frequency[0]) & (bla.frequency <= level.frequency[-1])]
        smooth = pooled(level, f, _POOL) if f.size > 1 else level
        handles.setdefault(name, _curve(axes, smooth, colour, (0, (5, 2))))


def _curve(axes: Axes, level: Level, colour: str, dash: Any) -> Any:
    (line,) = axes.plot(level.frequency, _db(level.variance), color=colour, linewidth=1.4, linestyle=dash)
    return line


def _db(variance: Array) -> Array:
    """10 log10, with gaps where an estimate is below what can be seen."""
    return 10 * np.log10(np.where(variance > 0, variance, np.nan))


def _floor(bla: BestLinearApproximation) -> float | None:
    """The lower end of the axis: a little under nearly all of the lowest noise."""
    level = bla.noise or bla.total
    seen = math.nan if level is None else float(np.nanquantile(_db(level.variance), _NEARLY_NONE))
    return seen - _BELOW_NOISE_DB if math.isfinite(seen) else None


def _gain_unit(bla: BestLinearApproximation) -> str:
    one, other = bla.test.output_unit, bla.test.input_unit
    if one == other:
        return ""
    return f" {one}" if other == "1" else f" {one}/{other}"
