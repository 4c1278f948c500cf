"""Models with effects, compiled: what a diagnosis takes, and what is written for the user."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from pysim.types import BadInput
from pysim.workflow.model import compiled

if TYPE_CHECKING:
    from pysim.effects import Slot
    from pysim.effects.learned import Term
    from pysim.types import Effect, Model


@dataclass(frozen=True)
class Variants:
    """Builds models with effects, each once.

    Args:
        class_name: of the base model.
        libraries: where it and the effects are.
    """

    class_name: str
    libraries: tuple[Path, ...]
    _built: dict[tuple[str, ...], tuple[Model, dict[str, str]]] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    @property
    def slots(self) -> tuple[Slot, ...]:
        """Replaceable parts of the base model."""
        from pysim.effects import slots

        return slots(self.class_name, self.libraries)

    def build(self, effects: Sequence[Effect]) -> tuple[Model, dict[str, str]]:
        """The model with these effects, and effect name -> the name ahead of its parameters there.

        Raises:
            BadInput: a class that cannot be made or does not compile.
        """
        key = tuple(effect.class_name for effect in effects)
        if key not in self._built:
            with TemporaryDirectory(prefix="pysim-variant-") as folder, _refusals():
                self._built[key] = self.write(effects, Path(folder), None)
        return self._built[key]

    def write(
        self,
        effects: Sequence[Effect],
        folder: Path,
        fmu: Path | None,
        name: str = "",
        values: Mapping[str, float] | None = None,
        comment: str = "",
        *,
        fmi: int = 2,
        platforms: Sequence[str] = ("host",),
    ) -> tuple[Model, dict[str, str]]:
        """Write the class into a folder and compile it, into the cache where no place is named.

        Args:
            name: of the class; the base model's with `Variant` behind it where none is given.
            values: parameters to set, by their full names.
            comment: lines ahead of the class.
            fmi, platforms: of the FMU, as `fmu_build.build` says.
        Raises:
            BadInput: a class that cannot be made or does not compile.
        """
        from pysim.effects import variant

        name = name or f"{self._own_name}Variant"
        made = variant(self.class_name, effects, self.libraries, name=name, values=values, comment=comment)
        return self._compiled(name, made.text, folder, fmu, fmi=fmi, platforms=platforms), made.places

    def probed(self, effects: Sequence[Effect], terms: Sequence[Term]) -> Model:
        """The model with these effects and terms, each a table at its place whose values are parameters.

        Raises:
            BadInput: a class that does not compile with these terms.
        """
        from pysim.effects import variant
        from pysim.effects.learned import wrapped

        name = f"{self._own_name}Located"
        made = variant(self.class_name, effects, self.libraries, name=f"{name}Base") if effects else None
        text = (made.text if made else "") + wrapped(made.class_name if made else self.class_name, terms, name)
        with TemporaryDirectory(prefix="pysim-located-") as folder, _refusals():
            return self._compiled(
                name, text, Path(folder), None, probes=[probe for term in terms for probe in term.probes]
            )

    @property
    def _own_name(self) -> str:
        return self.class_name.rpartition(".")[2]

    def _compiled(
        self,
        name: str,
        text: str,
        folder: Path,
        fmu: Path | None,
        *,
        fmi: int = 2,
        probes: Sequence[str] = (),
        platforms: Sequence[str] = ("host",),
    ) -> Model:
        source = folder / f"{name}.mo"
        source.write_text(text, encoding="utf-8")
        return compiled(name, [*self.libraries, source], fmu, fmi=fmi, probes=probes, platforms=platforms)


@contextmanager
def _refusals() -> Iterator[None]:
    """A candidate whose C does not compile, which is our mistake, is a candidate less."""
    from fmu_build.pack import CompilerError

    try:
        yield
    except CompilerError as error:
        raise BadInput(str(error)) from error
