"""A law that a model lacks, as the measurements show it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pysim.nouns.effect import Effect, effect_folder, own_effect
from pysim.nouns.model import Model
from pysim.nouns.table import Shown, Table
from pysim.types import BadInput, LearnedLaw, law_data
from pysim.types import Diagnosis as Answer
from pysim.types import Effect as Missing

if TYPE_CHECKING:
    from pysim.effects.learned import Formula


def laws_of(found: Answer, model: Model) -> tuple[Law, ...]:
    """The laws of an answer, those that were added ahead."""
    from pysim.present.diagnosis.figures import samples_of

    return tuple(Law(one, model, samples_of(found, one)) for one in found.laws)


@dataclass(frozen=True, repr=False)
class Law(Shown):
    """What is missing at one place: a curve with its 95 percent band.

    Args:
        found: all numbers.
        model: it was learned in.
        samples: (n,) of its argument in the logs; None where that was not logged.
    """

    found: LearnedLaw
    model: Model
    samples: Any = None

    @property
    def slot(self) -> str:
        """Place in the model."""
        return self.found.slot

    @property
    def argument(self) -> str:
        """The variable it depends on."""
        return self.found.argument

    @property
    def share(self) -> float:
        """Of the misfit that could be avoided, 0 ... 1."""
        return self.found.share

    @property
    def formula(self) -> str:
        """A short expression for the curve; "" where none fits."""
        if self.found.formula:
            return self.found.formula
        return self._formula.text(self.argument.removeprefix(f"{self.slot}.")) if self._formula else ""

    @cached_property
    def _formula(self) -> Formula | None:
        from pysim.effects.learned import formulas

        return next(iter(formulas(self.found)), None)

    @property
    def table(self) -> Table:
        """The curve: argument, value and its 95 percent band."""
        one = self.found
        low, high = one.band
        rows = list(zip(*(a.tolist() for a in (one.knots, one.coefficients, low, high)), strict=True))
        return Table.of((f"{one.argument} [{one.argument_unit}]", f"value [{one.unit}]", "95 % from", "to"), rows)

    @property
    def sentence(self) -> str:
        """What is missing, in words."""
        from pysim.present.diagnosis.law_words import law_sentence

        return law_sentence(replace(self.found, formula=self.formula))

    def plot(self, *, interactive: bool = False) -> Any:
        """The curve with its band, and where the data are; a Plotly figure of the curve where `interactive`."""
        from pysim.present.charts import as_plotly
        from pysim.present.diagnosis.figures.law import law_chart, law_figure

        if interactive:
            return as_plotly(law_chart(law_data(self.found)))
        return law_figure(self.found, self.samples)

    def to_effect(
        self, name: str, *, description: str = "", formula: bool = False, inner: Sequence[Missing] = ()
    ) -> Effect:
        """An effect whose law this curve is, to add to a model; `save(folder)` writes its class into a library.

        Args:
            formula: write the formula, its amounts and widths as parameters, in place of the curve.
            inner: one or two effects of the same slot that become part of it, since a slot takes one.
        Raises:
            BadInput: no class can be written for the slot, the name makes no name of a class, or no formula fits.
        """
        from pysim.workflow import class_name_of, keep_law

        if self.model.variants is None:
            raise BadInput(f"nothing can be added to {self.model.name}: its class is in no library")
        variants = self.model.variants
        within = "".join(f"|{one.class_name}|{one.law}" for one in inner)
        best = self._formula if formula else None
        if formula and best is None:
            raise BadInput(f"no formula fits the curve at {self.slot}; leave out formula=True", argument="formula")
        curve = self.found.coefficients.tobytes().hex() + ("|formula" if formula else "")
        folder = effect_folder(f"{name}|{description}|{self.found.slot}|{curve}{within}")
        file = folder / f"{class_name_of(name)}.mo"
        if not file.exists():
            keep_law(
                self.found,
                name,
                variants.class_name,
                variants.libraries,
                folder,
                description=description,
                formula=best,
                inner=inner,
            )
        return own_effect(file)

    def save(self, folder: Path | str, name: str) -> Path:
        """Write its class into a folder."""
        return self.to_effect(name).save(folder)

    @property
    def _words(self) -> list[str]:
        return [self.sentence]
