"""Best linear approximations as text and JSON."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.identify.multisine import distortion_p_value, gain_interval, pooled
from pysim.io import json_number, shown_value
from pysim.types import BestLinearApproximation, Distortion, Level

if TYPE_CHECKING:
    from numpy.typing import NDArray

_ROWS = 12  # frequencies in a table; all of them are in the data
_ALARM = 0.01  # p-value below which a distortion counts as seen
_POOL = 6  # free lines whose mean stands in a table
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


def text(result: Approximations) -> str:
    """Of each the verdicts, then some of the lines; "-" is below what the noise lets see."""
    return "\n\n".join(_text(name, bla) for name, bla in result.found)


def data(result: Approximations) -> dict[str, Any]:
    """Everything, numbers finite or None: gain unit is output per input unit, levels are variances in its square."""
    return {"approximations": [_data(name, bla) for name, bla in result.found]}


def _text(name: str, bla: BestLinearApproximation) -> str:
    rows = [heads(bla), *table_rows(bla)]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = ["  ".join(text.rjust(width) for text, width in zip(row, widths, strict=True)) for row in rows]
    return "\n".join([f"{name}: {bla.method}", *(f"  {line}" for line in verdicts(bla)), *(f"  {x}" for x in lines)])


def verdicts(bla: BestLinearApproximation) -> tuple[str, ...]:
    """What the numbers say, a sentence each."""
    test = bla.test
    done = (
        f"{test.realisations} realisation(s) of {test.periods} period(s) of {test.period:g} s, {bla.frequency.size} "
        f"lines from {bla.frequency[0]:g} to {bla.frequency[-1]:g} Hz; {test.input} around "
        f"{shown_value(test.offset, test.input_unit, '.4g')} with {shown_value(test.rms, test.input_unit, '.4g')} rms"
    )
    if bla.on_lines is None or bla.noise is None:
        return (done, "Without a second period noise and distortion cannot be told apart.")
    found = [_verdict(words, level) for words, level in (("even", bla.even), ("odd", bla.odd)) if level is not None]
    if bla.odd is None:
        found.append(_verdict("on the excited lines, even and odd together,", bla.on_lines))
    return (done, *found, _worst(bla))


def _data(name: str, bla: BestLinearApproximation) -> dict[str, Any]:
    test = bla.test
    magnitude, phase = gain_interval(bla)
    levels = {key: getattr(bla, key) for key in ("total", "noise", "distortion", "on_lines", "even", "odd")}
    return {
        "name": name,
        "method": bla.method,
        "origin": bla.origin,
        "test": {key: getattr(test, key) for key in test.__dataclass_fields__},
        "frequency_hz": bla.frequency.tolist(),
        "gain_real": bla.gain.real.tolist(),
        "gain_imag": bla.gain.imag.tolist(),
        "gain": np.abs(bla.gain).tolist(),
        "gain_half_width_95": magnitude.tolist(),
        "phase_deg": np.degrees(np.unwrap(np.angle(bla.gain))).tolist(),
        "phase_half_width_95_deg": np.degrees(phase).tolist(),
        "variance": bla.variance.tolist(),
        "degrees_of_freedom": bla.degrees.tolist(),
        "noise_variance": None if bla.noise_variance is None else bla.noise_variance.tolist(),
        "input_amplitude": bla.amplitude.tolist(),
        "output_mean": bla.mean,
        "output_mean_variance": json_number(bla.mean_variance),
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


def heads(bla: BestLinearApproximation) -> tuple[str, ...]:
    """Of the table; noise stands for everything where nothing tells it from distortion."""
    return tuple("noise + distortion dB" if bla.noise is None and head == "noise dB" else head for head in _HEADS)


def table_rows(bla: BestLinearApproximation) -> list[tuple[str, ...]]:
    """Some of the lines, in words, as `heads` names the columns."""
    f = bla.frequency
    wanted = np.geomspace(f[0], f[-1], min(_ROWS, f.size))
    at = np.unique(np.argmin(np.abs(np.log(f[:, None] / wanted)), axis=0))
    magnitude, phase = gain_interval(bla)
    size, angle = np.abs(bla.gain), np.degrees(np.unwrap(np.angle(bla.gain)))
    columns = [
        [f"{x:g}" for x in f[at]],
        [f"{x:.2f}" for x in 20 * np.log10(size[at])],
        [f"{x:.2f}" for x in 20 / np.log(10) * magnitude[at] / size[at]],
        [f"{x:.1f}" for x in angle[at]],
        [f"{x:.1f}" for x in np.degrees(phase[at])],
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
    data: dict[str, Any] = {
        "frequency_hz": level.frequency.tolist(),
        "variance": level.variance.tolist(),
        "low_95": level.low.tolist(),
        "high_95": level.high.tolist(),
    }
    if isinstance(level, Distortion):
        data |= {"power": level.power.tolist(), "noise": level.noise.tolist(), "p_value": distortion_p_value(level)}
    return data
