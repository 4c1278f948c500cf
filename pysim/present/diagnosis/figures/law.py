"""A learned law: what a place of the model lacks, over what it depends on; as a figure and as a chart."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.io import shown_unit
from pysim.present import style
from pysim.present.charts import Chart, axis, between, chart, level_line, plain, unit_text
from pysim.present.diagnosis.law_words import ABSORBED, formula_text, law_kind
from pysim.types import BadInput, LearnedLaw

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

_BINS = 60  # of the density of data


def law_figure(law: LearnedLaw, samples: NDArray[np.float64] | None = None) -> Figure:
    """The curve with its 95 percent band; below, where the data are, its formula, and what refitting does as well.

    Args:
        samples: (n,) of the argument in all logs, in its unit; None where they are not at hand.
    Raises:
        BadInput: a curve without two knots.
    """
    if law.knots.size < 2:
        raise BadInput(f"learned law at {law.slot}: a picture needs two knots, the curve has {law.knots.size}")
    (unit_in, scale_in), (unit_out, scale_out) = shown_unit(law.argument_unit), shown_unit(law.unit)
    seen = np.unique(np.clip(law.knots, *law.reach))
    curve, low, high = (np.interp(seen, law.knots, values) * scale_out for values in (law.coefficients, *law.band))
    z = seen * scale_in
    ratios = [6] if samples is None else [6, 1]
    figure, axes = style.panels(6.4, 4.2, len(ratios), sharex=True, height_ratios=ratios)
    top, bottom = axes[0, 0], axes[-1, 0]
    if samples is not None:
        _density(bottom, samples * scale_in, z)
    band = top.fill_between(z, low, high, color=style.COLOURS[0], alpha=0.25, linewidth=0)
    (line,) = top.plot(z, curve, color=style.COLOURS[0], linewidth=1.5)
    top.axhline(0.0, color=style.LIMIT, linewidth=0.9)
    top.set_xlim(z[0], z[-1])
    bottom.set_xlabel(f"{law.argument} ({unit_in})")
    top.set_ylabel(f"Missing {law_kind(law)} at {law.slot} ({unit_out})")
    style.legend_above(figure, [line, band], [f"explains {100 * law.share:.0f} % of the misfit", "95 % band"])
    notes = [*filter(None, [formula_text(law.formula, str(law.factor), law.unit)])]
    if law.alternatives:
        notes.append(f"these data cannot tell it from a law at {', '.join(law.alternatives)}")
    if law.absorbed.size:
        notes.append(ABSORBED)
    if notes:
        figure.supxlabel("\n".join(notes), fontsize=style.SMALL)
    return figure


def _density(axes: Axes, samples: NDArray[np.float64], knots: NDArray[np.float64]) -> None:
    axes.hist(samples, bins=_BINS, range=(float(knots[0]), float(knots[-1])), color=style.MEASURED, alpha=0.5)
    axes.set_yticks([])
    axes.set_ylabel("Data", fontsize=style.SMALL)


def law_chart(law: Mapping[str, Any], written: Sequence[float] | None = None) -> Chart:
    """The curve over what it depends on, with its 95 percent band.

    Args:
        law: of `missing` in the answer.
        written: another law at the same places, as a user wrote it.
    """
    shape = law["shape"]
    (unit_in, scale_in), (unit_out, scale_out) = shown_unit(shape["argument_unit"]), shown_unit(shape["unit"])
    x = [v * scale_in for v in shape["argument"]]
    y, low, high = ([v * scale_out for v in shape[name]] for name in ("value", "low", "high"))
    line: dict[str, Any] = {"x": x, "y": y, "mode": "lines+markers", "name": "learned law"}
    line |= {"line": {"color": "@final", "width": 2.5}, "marker": {"size": 6, "color": "@final"}}
    lines = [between(x, low, high, "@finalband", name="95 % band"), line]
    if written is not None:
        look = {"mode": "lines", "name": "as written", "line": {"color": "@base", "width": 2.5, "dash": "dash"}}
        lines.append({"x": x, "y": [v * scale_out for v in written], **look})
    where = plain(law["slot"] + (f" / {law['factor']}" if law["factor"] else ""))
    return chart(
        lines,
        xaxis=axis(f"{plain(law['depends_on'])} ({unit_text(unit_in)})"),
        yaxis=axis(f"missing at {where} ({unit_text(unit_out)})"),
        shapes=[level_line(0, "@line", 1)],
    )
