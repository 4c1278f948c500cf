"""The term that a place of the model lacks, over what it depends on."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pysim.io import shown_unit
from pysim.present.style import COLOURS, LIMIT, SMALL, TEXT, legend_above, new_figure, quiet
from pysim.types import BadInput, Missing

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_KINDS = {"N": "force", "m3/s": "flow", "Pa": "pressure", "N.m": "torque", "m": "position", "rad": "angle"}


def missing_figure(missing: Missing) -> Figure:
    """The missing force, flow or signal with its 95 percent band; below, what refitting would absorb of it.

    Raises:
        BadInput: a shape without two points.
    """
    shape = missing.shape
    if shape.argument.size < 2:
        raise BadInput(
            f"missing term at {missing.slot}: a picture needs two points, the shape has {shape.argument.size}"
        )
    unit_in, scale_in = shown_unit(shape.argument_unit)
    unit_out, scale_out = shown_unit(shape.unit)
    z = shape.argument * scale_in
    figure = new_figure(6.4, 4.2)
    axes = figure.subplots()
    band = axes.fill_between(
        z, shape.low * scale_out, shape.high * scale_out, color=COLOURS[0], alpha=0.25, linewidth=0
    )
    (line,) = axes.plot(z, shape.value * scale_out, color=COLOURS[0], linewidth=1.5)
    axes.axhline(0.0, color=LIMIT, linewidth=0.9)
    axes.set_xlim(float(z[0]), float(z[-1]))
    axes.set_xlabel(f"{missing.depends_on} ({unit_in})", fontsize=TEXT)
    kind = _KINDS.get(shape.unit, "term")
    axes.set_ylabel(f"Missing {kind} at {missing.slot} ({unit_out})", fontsize=TEXT)
    quiet(axes)
    legend_above(figure, [line, band], [f"takes {100 * missing.share:.0f} % of the misfit", "95 % band"])
    notes = [missing.formula] if missing.formula else []
    if missing.alike:
        notes.append(f"these data do not tell it from a term at {', '.join(missing.alike)}")
    if shape.absorbed.size:
        notes.append("up to a level or slope that the model's own parameters do as well")
    if notes:
        figure.supxlabel("\n".join(notes), fontsize=SMALL)
    return figure
