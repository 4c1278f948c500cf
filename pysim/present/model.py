"""What a model holds, shown: text and JSON; a model and the law of an effect as sketches."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pysim.present import style
from pysim.present.charts import Chart, axis, chart, plain

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from pysim.effects import Sketch, Slot
    from pysim.types import Effect, Model, Variable

_ABREAST = 5  # slots in a row of a sketch
_STROKES = ("@final", "@base", "@prior")  # of a law, in a chart


@dataclass(frozen=True)
class Inside:
    """A model with what its libraries know of it.

    Args:
        class_name: of the model; "" for an FMU without its class.
        slots: of the class.
        effects: that the slots take.
        libraries: of the user.
    """

    model: Model
    class_name: str
    slots: tuple[Slot, ...]
    effects: tuple[Effect, ...]
    libraries: tuple[Path, ...]


def text(result: Inside) -> str:
    """Inputs, outputs, parameters with bounds, and slots with what they take."""
    model, slots, effects = result.model, result.slots, result.effects
    lines = [f"{model.name}, FMI {model.abilities.fmi}, {len(model.abilities.states)} states"]
    for causality in ("input", "output"):
        lines += [f"{causality}s", *(f"  {v.name} [{v.unit}] {v.description}".rstrip() for v in _of(model, causality))]
    lines.append("parameters with bounds; a diagnosis refits by itself those with a nominal value")
    bounded = [v for v in _of(model, "parameter") if None not in (v.start, v.min, v.max)]
    lines += [f"  {v.name} = {v.start:g}, {_range(v)} [{v.unit}] {v.description}".rstrip() for v in bounded]
    for slot in slots:
        own = ", ".join(effect.name for effect in effects if effect.slot == slot.name) or "no effect of the libraries"
        lines.append(f"slot {slot.name}: {own}")
    return "\n".join(lines)


def data(result: Inside) -> dict[str, Any]:
    """All of it, with its parts and their links, and a picture of each effect's law."""
    from pysim.effects import STANDARD_LIBRARY, read_pairs
    from pysim.effects.structure import structure

    libraries = [STANDARD_LIBRARY, *result.libraries]
    found = _data(result.model, result.class_name, result.slots)
    # parts and what links them; not known of an FMU without its class
    found["structure"] = asdict(structure(result.class_name, libraries)) if result.class_name else None
    found["pairs"] = [[pair.slot, *pair.of] for pair in read_pairs(*libraries)]  # effects that share a slot
    found["effects"] = [_effect(effect, result.model, result.slots, libraries) for effect in result.effects]
    return found


def _data(model: Model, class_name: str, slots: tuple[Slot, ...]) -> dict[str, Any]:
    shown, fmi = ("input", "output", "local"), model.abilities.fmi
    variables = [v for v in model.variables if v.causality in shown and (fmi == 3 or v.type == "Real")]
    return {
        "name": model.name,
        "class": class_name,
        "fmi": fmi,
        "states": list(model.abilities.states),
        "variables": [[v.name, v.causality, v.unit, v.description] for v in variables],
        "parameters": [
            {"name": v.name, "unit": v.unit, "start": v.start, "min": v.min, "max": v.max, "nominal": v.nominal}
            | {"about": v.description}
            for v in _of(model, "parameter")
        ],
        "slots": [{"name": s.name, "about": s.description, "sees": s.sees, "gives": s.gives} for s in slots],
    }


def _effect(effect: Effect, model: Model, slots: tuple[Slot, ...], libraries: list[Path]) -> dict[str, Any]:
    """What an effect is, with a picture of its law where a few strokes show it."""
    from pysim.effects import law_constants, law_sketch

    slot = next(slot for slot in slots if slot.name == effect.slot)
    around = {v.name: (v.start, v.unit) for v in _of(model, "parameter") if v.start is not None}
    constants = law_constants(effect, libraries)
    drawn = law_sketch(effect, slot, constants, around)
    parameters = [
        {"name": p.name, "unit": p.unit, "nominal": p.nominal, "default": p.default, "about": p.description}
        for p in effect.parameters
    ]
    about = {"name": effect.name, "slot": effect.slot, "class": effect.class_name, "about": effect.description}
    picture = None if drawn is None else asdict(drawn)
    return {**about, "law": effect.law, "parameters": parameters, "constants": constants, "sketch": picture}


def model_figure(
    title: str, inputs: Sequence[str], outputs: Sequence[str], inside: Sequence[str], slots: Sequence[str]
) -> Figure:
    """A sketch: inputs into a box with some lines, outputs out of it, and boxes of its slots below."""
    tall = 0.2 * max(len(inputs), len(outputs), len(inside), 3)  # in
    below = 0.55 * -(-len(slots) // _ABREAST)
    figure = style.new_figure(8.0, 0.6 + tall + below)
    axes = figure.subplots()
    axes.set(xlim=(0, 1), ylim=(-below / tall, 1))
    axes.set_title(title, fontsize=style.TEXT)
    axes.axis("off")
    axes.plot([0.3, 0.7, 0.7, 0.3, 0.3], [0, 0, 1, 1, 0], color="black", linewidth=1.0, clip_on=False)
    axes.text(0.5, 0.5, "\n".join(inside), ha="center", va="center", fontsize=style.SMALL)
    for names, (near, far), at, side in ((inputs, (0.3, 0.25), 0.24, "right"), (outputs, (0.75, 0.7), 0.76, "left")):
        for k, name in enumerate(names):
            y = 1 - (k + 0.5) / len(names)
            axes.annotate("", (near, y), (far, y), arrowprops={"arrowstyle": "->"})
            axes.text(at, y, name, ha=side, va="center", fontsize=style.SMALL)
    frame = {"boxstyle": "square,pad=0.3", "facecolor": "white", "edgecolor": style.LIMIT}
    for k, words in enumerate(slots):
        row, place = divmod(k, _ABREAST)
        at_x, at_y = (place + 0.5) / min(len(slots), _ABREAST), -(row + 0.6) * 0.55 / tall
        axes.text(at_x, at_y, words, ha="center", va="center", fontsize=style.SMALL, bbox=frame)
    return figure


def model_chart(
    title: str, inputs: Sequence[str], outputs: Sequence[str], inside: Sequence[str], slots: Sequence[str]
) -> Chart:
    """Inputs, a box with some lines, outputs, and the slots below."""
    box = {"type": "rect", "x0": 0.3, "x1": 0.7, "y0": 0.35, "y1": 1, "line": {"color": "@ink", "width": 1.2}}
    columns = [(0.28, inputs, " →", "right"), (0.5, inside, "", "center"), (0.72, outputs, "", "left")]
    notes = [_words(x, 0.67, [f"{one}{end}" for one in names], side) for x, names, end, side in columns if names]
    for k, one in enumerate(slots):
        at = _words((k + 0.5) / len(slots), 0.15, one.splitlines(), "center")
        notes.append({**at, "bordercolor": "@line", "borderwidth": 1, "borderpad": 6})
    hidden = {"visible": False, "range": [0, 1]}
    return chart([], shapes=[box], annotations=notes, xaxis=hidden, yaxis=hidden, title={"text": plain(title)})


def _words(x: float, y: float, lines: Sequence[str], side: str) -> dict[str, Any]:
    return {"x": x, "y": y, "xanchor": side, "text": "<br>".join(map(plain, lines)), "showarrow": False}


def sketch_figure(sketch: Sketch, name: str) -> Figure:
    """The strokes of a law: its curve, some curves of a family, or a wave and the answer to it.

    Args:
        name: of the effect.
    """
    figure, ((axes,),) = style.panels(4.6, 3.4)
    axes.axhline(0.0, color=style.LIMIT, linewidth=0.8)
    for k, (x, y) in enumerate(sketch.curves):
        axes.plot(x, y, **style.look(k, "linestyle"), linewidth=1.6)
    axes.set_title(f"{name}: {sketch.words}", fontsize=style.TEXT)
    axes.set(xticks=[], yticks=[])
    return figure


def sketch_chart(sketch: Sketch, name: str) -> Chart:
    """The strokes of a law, without numbers."""
    lines = [
        {"x": list(x), "y": list(y), "mode": "lines", "line": {"color": _STROKES[k % len(_STROKES)], "width": 2.5}}
        for k, (x, y) in enumerate(sketch.curves)
    ]
    quiet: dict[str, Any] = {"showticklabels": False}
    title = f"{plain(name)}: {plain(sketch.words)}"
    return chart(lines, xaxis=axis(**quiet), yaxis=axis(**quiet), title={"text": title}, showlegend=False)


def _of(model: Model, causality: str) -> list[Variable]:
    return [v for v in model.variables if v.causality == causality]


def _range(v: Variable) -> str:
    nominal = "" if v.nominal is None else f", nominal {v.nominal:g}"
    return f"{v.min:g} to {v.max:g}{nominal}"
