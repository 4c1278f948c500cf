"""Tuned loops, shown: text, JSON, figure and page.

The figure has open and closed loop over frequency as in thesis Figures 6.1 and 6.2, and the answers over time.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.control.tuning import Gains, loop_response, stable_when_sampled
from pysim.control.tuning.margins import open_loop
from pysim.present.page import heading, items, pictures, table
from pysim.present.page import page as whole_page
from pysim.present.plain_text import aligned
from pysim.present.render import Drawing, Picture
from pysim.present.style import LIMIT, TEXT, frequency_axis, legend_above, look, panels, phase_axis
from pysim.types import BadInput
from pysim.types.json_number import json_data

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

_STEPS = 40  # of the sampled controller, at least, in the right column
_POINTS = 400  # at least, of a curve there
_MOST = 50_000  # steps of the sampled controller there, some seconds of work
_PICTURE = 4.0  # steps of the reference; an answer that grows beyond is cut off
_METHOD = (
    "The controller is K_p (1 + 1/(T_i s)), thesis Eq. 5.32. Phase margin and crossover fix both of its numbers.",
    "Margins are those of a controller that is not sampled, and count the plant's dead time, if it was given one. "
    "A loop is called stable only if it is so under the sampled controller too. The steps over time are its own. A "
    f"loop that needs more than {_MOST:,} of its samples is drawn with a longer sampling time.",
    "The maximum of sensitivity tells how much the loop amplifies a disturbance at the worst frequency; 1.5 to 2 is "
    "usual.",
)
_HEAD = ("K_p", "T_i (s)", "K_p/T_i", "crossover (Hz)", "phase margin (deg)", "gain margin (dB)", "delay (s)", "M_s")
_SHORT = ("K_p", "T_i (s)", "K_p/T_i", "cross (Hz)", "phase (deg)", "gain (dB)", "delay (s)", "M_s")  # of a terminal


@dataclass(frozen=True)
class Tuning:
    """Loops on one plant.

    Args:
        loops: label -> gains; at least one.
        dt: s between the sampled controller's steps.
        beside: labels of the loops that are shown for comparison only.
    """

    loops: Mapping[str, Gains]
    dt: float
    beside: frozenset[str] = frozenset()

    @cached_property
    def stable(self) -> Mapping[str, bool]:
        """Label -> whether the loop is stable, under the sampled controller too."""
        return {
            label: g.loop.stable and stable_when_sampled(g.plant, g.K_p, g.T_i, dt=self.dt)
            for label, g in self.loops.items()
        }

    @property
    def passes(self) -> bool:
        """Whether all loops that were asked for are stable."""
        return all(stable for label, stable in self.stable.items() if label not in self.beside)

    @property
    def warnings(self) -> tuple[str, ...]:
        """A sentence for each loop that was asked for and is not stable."""
        unsampled = f"with a controller that is sampled every {self.dt:g} s; take a shorter sampling time (dt), or"
        return tuple(
            f"The loop {label} is unstable{f' {unsampled}' if self.loops[label].loop.stable else '; take'} other gains."
            for label, stable in self.stable.items()
            if not stable and label not in self.beside
        )


def text(result: Tuning) -> str:
    """A row per loop: gains, crossover, phase, gain and delay margin, largest sensitivity; what is not stable."""
    width = max(map(len, result.loops))
    rows = [[" " * width, *_SHORT], *([f"{label:<{width}}", *_cells(gains)] for label, gains in result.loops.items())]
    ends = ["stable", *("yes" if stable else "NO" for stable in result.stable.values())]
    table_rows = [f"{line}  {end}" for line, end in zip(aligned(rows), ends, strict=True)]
    return "\n".join([*table_rows, *result.warnings])


def data(result: Tuning) -> dict[str, Any]:
    """Everything, frequencies in Hz, margins in degrees and dB; null where there is none."""
    return json_data({label: _data(gains, result.stable[label]) for label, gains in result.loops.items()})


def figures(result: Tuning) -> Iterator[Picture]:
    """All loops in one."""
    caption = "Open loop with its crossovers, closed loop, and the sampled loop after unit steps."
    yield Picture("tuning", caption, tuning_figure(result.loops, dt=result.dt))


def page(result: Tuning, drawings: Sequence[Drawing], redo: str) -> str:
    """How it was done, the picture, gains and margins."""
    first = next(iter(result.loops.values()))
    rows = [[label, *_cells(g), "yes" if result.stable[label] else "no"] for label, g in result.loops.items()]
    parts = [heading("How it was done"), items(_METHOD), heading("Loops"), *pictures(drawings)]
    parts += [items(result.warnings)] if result.warnings else []
    parts.append(table("Gains and margins", ["", *_HEAD, "stable"], rows, words=[0]))
    return whole_page("Tuning of a PI controller", f"Plant: {first.plant.name}.", parts, redo)


def _cells(gains: Gains) -> list[str]:
    loop = gains.loop
    margin = 20 * math.log10(loop.gain_margin) if 0 < loop.gain_margin < math.inf else math.inf
    return [
        f"{gains.K_p:.4g}",
        f"{gains.T_i:.4g}",
        f"{gains.integral:.4g}",
        f"{loop.crossover / (2 * math.pi):.4g}",
        f"{math.degrees(loop.phase_margin):.2f}",
        f"{margin:.1f}",
        f"{loop.delay_margin:.3g}",
        f"{loop.peak_sensitivity:.2f}",
    ]


def _data(gains: Gains, stable: bool) -> dict[str, Any]:
    loop = gains.loop
    return {
        "plant": gains.plant.name,
        "K_p": gains.K_p,
        "T_i": gains.T_i,
        "crossover_hz": loop.crossover / (2 * math.pi),
        "phase_margin_deg": math.degrees(loop.phase_margin),
        "gain_margin_db": 20 * math.log10(loop.gain_margin),
        "delay_margin_s": loop.delay_margin,
        "peak_sensitivity": loop.peak_sensitivity,
        "bandwidth_hz": loop.bandwidth / (2 * math.pi),
        "stable": stable,
        "stable_unsampled": loop.stable,
    }


def tuning_figure(loops: Mapping[str, Gains], *, dt: float) -> Figure:
    """Left the open loop with its crossovers, in the middle the closed loop, right the answers to two unit steps:
    of the reference, and of a disturbance at the plant's input as a share of what it would come to without controller.
    A loop that is stable and under the sampled controller goes off is drawn until it leaves the picture.

    Args:
        loops: label -> gains on their plant.
        dt: s between the sampled controller's steps, for the right column.
    Raises:
        BadInput: no loop.
    """
    if not loops:
        raise BadInput("tuning figure: needs at least one loop")
    figure, axes = panels(11.0, 5.6, 2, 3)
    for top, bottom in axes.T:
        top.sharex(bottom)
    hertz = _range(loops)
    handles: dict[str, Artist] = {}
    for k, (label, gains) in enumerate(loops.items()):
        own = look(k, "linestyle")
        handles[label] = _draw_frequency(axes, gains, hertz, own)
        _draw_time(axes[:, 2], gains, dt, _stop(loops.values(), dt), own)
    _label(axes, hertz)
    legend_above(figure, list(handles.values()), list(handles))
    return figure


def _range(loops: Mapping[str, Gains]) -> Array:
    """Hz (n,), two decades on either side of the crossovers, and up to the plants' own corners."""
    crossovers = [float(w) for gains in loops.values() for w in gains.loop.crossovers] or [1.0]
    corners = [abs(p) for gains in loops.values() for p in gains.plant.poles()]
    low, high = min(crossovers) / 50, max(50 * max(crossovers), 1.5 * max(corners, default=0.0))
    return np.asarray(np.geomspace(low, high, 4000) / (2 * np.pi), dtype=np.float64)


def _stop(loops: Iterable[Gains], dt: float) -> float:
    """s, until the slowest loop that comes to rest has done so, and the sampled controller has shown what it does."""
    slowest = min((g.loop.crossovers.min() for g in loops if g.loop.crossovers.size), default=1.0)
    return float(max(7 / slowest, _STEPS * dt))


def _draw_frequency(axes: NDArray[np.object_], gains: Gains, hertz: Array, own: Mapping[str, Any]) -> Artist:
    omega = 2 * np.pi * hertz
    loop = open_loop(gains.plant, gains.K_p, gains.T_i, omega)
    for column, response in enumerate((loop, loop / (1 + loop))):
        (line,) = axes[0, column].plot(hertz, 20 * np.log10(np.abs(response)), **own, linewidth=1.5)
        axes[1, column].plot(hertz, np.degrees(np.unwrap(np.angle(response))), **own, linewidth=1.5)
    at = gains.loop.crossovers
    phase = np.interp(at, omega, np.degrees(np.unwrap(np.angle(loop))))
    dots = {"color": own["color"], "linestyle": "none", "marker": "o", "markersize": 4}
    axes[0, 0].plot(at / (2 * np.pi), np.zeros(at.size), **dots)
    axes[1, 0].plot(at / (2 * np.pi), phase, **dots)
    return line


def _draw_time(axes: NDArray[np.object_], gains: Gains, dt: float, stop: float, own: Mapping[str, Any]) -> None:
    if not gains.loop.stable:
        return
    stop = min(stop, max(_stop([gains], dt), _MOST * dt))
    dt = max(dt, stop / _MOST)
    parts = math.ceil(dt * _POINTS / stop)
    answer = partial(loop_response, gains.plant, gains.K_p, gains.T_i, dt=dt, stop=stop, parts=parts)
    step, hit = answer(), answer(reference=0.0, disturbance=1.0)
    end = _leaves(step.output)
    axes[0].plot(step.time[:end], step.output[:end], **own, linewidth=1.5)
    axes[1].plot(hit.time[:end], hit.output[:end] / _steady(gains), **own, linewidth=1.5)
    if end < step.time.size:
        at = (float(step.time[end - 1]), float(step.output[end - 1]))
        axes[0].annotate("goes off", at, color=own["color"], fontsize=TEXT)


def _leaves(output: Array) -> int:
    """How many of an answer's points to draw: all, but of one that still grows those in the picture."""
    size = np.abs(output)
    late = 3 * size.size // 4
    beyond = size > _PICTURE
    if not beyond.any() or size[late:].max() < size[:late].max(initial=0.0):
        return size.size
    return max(1, int(np.argmax(beyond)))


def _steady(gains: Gains) -> float:
    """What the disturbance would come to without controller; 1 where that has no end."""
    last = gains.plant.denominator[-1]
    return gains.plant.numerator[-1] / last if last else 1.0


def _label(axes: NDArray[np.object_], hertz: Array) -> None:
    for column, name in enumerate(("Open loop", "Closed loop")):
        frequency_axis(axes[1, column], float(hertz[0]), float(hertz[-1]))
        axes[0, column].tick_params(labelbottom=False)
        axes[0, column].set_title(name, fontsize=TEXT)
        axes[1, column].set_xlabel("Frequency (Hz)")
        phase_axis(axes[1, column])
        axes[0, column].axhline(0.0, color=LIMIT, linewidth=0.8)
    axes[1, 0].axhline(-180.0, color=LIMIT, linewidth=0.8)
    axes[0, 0].set_ylabel("Magnitude (dB)")
    axes[1, 0].set_ylabel("Phase (deg)")
    axes[0, 2].tick_params(labelbottom=False)
    axes[0, 2].set_title("Sampled loop", fontsize=TEXT)
    axes[0, 2].set_ylabel("Step of the reference (-)")
    axes[1, 2].set_ylabel("Disturbance at the input (-)")
    axes[1, 2].set_xlabel("Time (s)")
