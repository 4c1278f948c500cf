"""An effect of the user's own, from a formula."""

from __future__ import annotations

import hashlib
import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pysim.nouns.model import Model, model_given, opened
from pysim.nouns.table import Shown, Table
from pysim.types import BadInput
from pysim.types import Effect as Described
from pysim.types.kinds import path_of

if TYPE_CHECKING:
    from pysim.effects import Slot
    from pysim.workflow.own_law import Given


def effect(
    name: str, *, at: str, law: str, model: Model | None = None, description: str = "", **parameters: Given
) -> Effect:
    """Write the class of an effect from its formula.

    A parameter whose range holds zero and without which the law vanishes is a strength: it is 0 until it is fitted. Any
    other one shapes the law, and has its usual value.

    Args:
        name: of the effect, "my.drag" -> class MyDrag.
        at: slot that it fills, of a model that was opened.
        law: an expression for what the slot gives, or equations "f = ...". It may name the slot's variables, the
            parameters, `time`, and the functions tanh, exp, sqrt, abs, max, min, sin, cos and sign.
        model: whose slot it is; needed where models that were opened have different slots of that name.
        description: in words.
        parameters: name = (lowest, highest, usual, unit), the unit SI.
    Raises:
        BadInput: no such slot, or what a law may not hold, with its place in the text.
    """
    from pysim.io import write_file
    from pysim.workflow import class_name_of, effect_class

    slot, libraries = _slot(at, model)
    text = effect_class(name, slot, law, parameters, libraries, description=description)
    file = effect_folder(text) / f"{class_name_of(name)}.mo"
    if not file.exists():
        file.parent.mkdir(parents=True, exist_ok=True)
        write_file(file, text)
    return own_effect(file, slot)


def own_effect(file: Path, slot: Slot | None = None) -> Effect:
    """The effect of a file that holds one."""
    from pysim.effects import read_catalogue

    (found,) = read_catalogue(file)
    return Effect(found, file, slot)


def effect_folder(content: str) -> Path:
    """Where the class of this content is kept until it is saved."""
    from pysim.io import cache_folder

    return cache_folder("effects") / hashlib.sha256(content.encode()).hexdigest()[:24]


@dataclass(frozen=True, repr=False)
class Effect(Shown):
    """An effect that can be added to a model: `model.with_effects(effect)`.

    Args:
        found: its slot, parameters and law.
        file: that holds its class.
        filled: the slot as its model declares it; None where that is not at hand.
    """

    found: Described
    file: Path
    filled: Slot | None = None

    @property
    def name(self) -> str:
        """Its standard name."""
        return self.found.name

    @property
    def slot(self) -> str:
        """The part of a model that it fills."""
        return self.found.slot

    @property
    def law(self) -> str:
        """Its equations."""
        return self.found.law

    @property
    def modelica(self) -> str:
        """The class, to keep in a library of yours."""
        return self.file.read_text(encoding="utf-8")

    @property
    def parameters(self) -> Table:
        """Name, bounds, usual size, unit, and whether it is 0 until it is fitted."""
        rows = [
            (p.name, p.min, p.max, p.nominal, "" if p.unit == "1" else p.unit, p.off is not None)
            for p in self.found.parameters
        ]
        return Table.of(("parameter", "min", "max", "usual", "unit", "0 is off"), rows, key="parameter")

    def plot(self, *, interactive: bool = False) -> Any:
        """The law at usual sizes, over its first variable; without numbers, as its range is the model's.

        Args:
            interactive: a Plotly figure in place of Matplotlib's.
        """
        from pysim.effects import law_constants, law_sketch
        from pysim.present.charts import as_plotly
        from pysim.present.model import sketch_chart, sketch_figure

        drawn = None
        if self.filled is not None:
            drawn = law_sketch(self.found, self.filled, law_constants(self.found, [self.file]), {})
        if drawn is None:
            raise BadInput(
                f"effect {self.name}: its law is more than a few strokes can show; simulate the model with it"
            )
        if interactive:
            return as_plotly(sketch_chart(drawn, self.name))
        return sketch_figure(drawn, self.name)

    def save(self, folder: Path | str) -> Path:
        """Write the class into a folder; the path of its file.

        Raises:
            BadInput: the file is there already and holds something else.
        """
        place = path_of(folder, "folder") / self.file.name
        if place.parent.is_file() or place.parent.suffix == ".mo":
            raise BadInput(
                f"{place.parent}: the class goes into {place.name}; name the folder of it", argument="folder"
            )
        place.parent.mkdir(parents=True, exist_ok=True)
        if place.exists() and place.read_text(encoding="utf-8") != self.modelica:
            raise BadInput(f"{place} is there already; give the effect another name or folder")
        shutil.copyfile(self.file, place)
        return place

    @property
    def table(self) -> Table:
        """The parameters."""
        return self.parameters

    @property
    def _words(self) -> list[str]:
        law = self.law if len(self.law) < 500 else f"{self.law[:497]}..."
        return [f"{self.name} at {self.slot}: {law}"]


def _slot(at: str, model: Model | None) -> tuple[Slot, tuple[Path, ...]]:
    """The slot, and the libraries that hold what it takes."""
    if model is not None:
        model = model_given(model, "effect")
        return model.slot(at), model.libraries
    found = {}
    for one in opened:
        for slot in one.inside.slots:
            if slot.name == at:
                found[slot.takes] = (slot, one.libraries)
    if not found:
        names = sorted({slot.name for one in opened for slot in one.inside.slots})
        cure = f"they have {', '.join(names)}" if names else "open one ahead: pysim.model(...)"
        raise BadInput(f"effect: no model that was opened has a slot {at!r}; {cure}", argument="at")
    if len(found) > 1:
        raise BadInput(
            f"effect: models that were opened have different slots {at!r}; say which: model=...", argument="model"
        )
    return next(iter(found.values()))
