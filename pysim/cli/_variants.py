"""Models with effects, compiled: what a diagnosis is handed, and what is written for the user."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pysim.diagnose.locating.laws import Term
    from pysim.types import Effect, Model


@dataclass
class Variants:
    """Builds models with effects, each once.

    Args:
        class_name: of the base model.
        libraries: where it and the effects are.
        built: names of effects -> the model, and effect name -> the name ahead of its parameters there.
    """

    class_name: str
    libraries: list[Path]
    built: dict[tuple[str, ...], tuple[Model, dict[str, str]]] = field(default_factory=dict)

    def __call__(self, effects: Sequence[Effect]) -> tuple[Model, dict[str, str]]:
        """The model with these effects, and where they are in it.

        Raises:
            BadInput: a class that cannot be made or does not compile.
        """
        key = tuple(effect.name for effect in effects)
        if key not in self.built:
            from tempfile import TemporaryDirectory

            with TemporaryDirectory(prefix="pysim-variant-") as folder, _refusals():
                self.built[key] = self.write(effects, Path(folder), None)
        return self.built[key]

    def write(
        self,
        effects: Sequence[Effect],
        folder: Path,
        fmu: Path | None,
        name: str = "",
        values: Mapping[str, float] | None = None,
        comment: str = "",
    ) -> tuple[Model, dict[str, str]]:
        """Write the class into a folder and compile it, into the cache where no place is named.

        Args:
            name: of the class; the base model's with `Variant` behind it where none is given.
            values: parameters to set, by their full names.
            comment: lines ahead of the class.
        """
        import fmu_build
        from pysim.effects import variant
        from pysim.io import read_model

        name = name or f"{self.class_name.rpartition('.')[2]}Variant"
        made = variant(self.class_name, effects, self.libraries, name=name, values=values, comment=comment)
        source = folder / f"{name}.mo"
        source.write_text(made.text, encoding="utf-8")
        built = fmu_build.build(name, fmu, libraries=[*self.libraries, source])
        return read_model(built), made.places

    def probed(self, effects: Sequence[Effect], law: Term) -> Model:
        """The model with these effects and a term at one place of it, as a table whose values are parameters.

        Raises:
            BadInput: a class that does not compile with that term.
        """
        from tempfile import TemporaryDirectory

        import fmu_build
        from pysim.diagnose.locating.laws import wrapped
        from pysim.effects import variant
        from pysim.io import read_model

        name = f"{self.class_name.rpartition('.')[2]}Located"
        made = variant(self.class_name, effects, self.libraries, name=f"{name}Base") if effects else None
        text = (made.text if made else "") + wrapped(made.class_name if made else self.class_name, law, name)
        with TemporaryDirectory(prefix="pysim-located-") as folder, _refusals():
            source = Path(folder) / f"{name}.mo"
            source.write_text(text, encoding="utf-8")
            return read_model(fmu_build.build(name, libraries=[*self.libraries, source], probes=law.probes))


@contextmanager
def _refusals() -> Iterator[None]:
    """What cannot be built is a candidate less; also where the C of it does not compile, which is our mistake."""
    from fmu_build import BuildError
    from fmu_build.pack import CompilerError
    from pysim.types import BadInput

    try:
        yield
    except (BuildError, CompilerError) as error:
        raise BadInput(str(error)) from error
