"""Say which physical effect a model lacks, from measurements."""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pysim.types import Diagnosis, Effect, Model


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The words behind `pysim diagnose`."""
    from pysim.cli._options import add_parameters

    parser.add_argument("data", metavar="DATASET", type=Path)
    parser.add_argument("--model", metavar="MODEL", required=True, help="a Modelica class with slots, or its .fmu")
    parser.add_argument(
        "--library", metavar="PATH", type=Path, action="append", default=[], help="of the class or of effects; repeat"
    )
    parser.add_argument("--free", metavar="NAME,...", default="", help="parameters to refit; those with bounds")
    parser.add_argument(
        "--bounds", metavar="NAME=LOW:HIGH", action="append", default=[], help="in place of the model's min and max"
    )
    parser.add_argument("--effects", metavar="NAME,...", default="", help="consider only these of the catalogue")
    parser.add_argument("--most", metavar="N", type=int, default=3, help="effects to add at most (3)")
    parser.add_argument("--seed", metavar="S", type=int, default=0, help="of the bootstrap (0)")
    parser.add_argument("--json", metavar="FILE", type=Path, help="write the whole answer here")
    parser.add_argument("--output", metavar="DIR", type=Path, help="write the extended class and its FMU here")
    add_parameters(parser)


def run(args: argparse.Namespace) -> int:
    """Print the story as it unfolds; 0 with a verdict, whatever it is."""
    from pysim.cli._options import bounded, read_parameters
    from pysim.cli._outputs import prepare_file, prepare_folder
    from pysim.cli._progress import announce_compilation
    from pysim.diagnose import diagnose, subject
    from pysim.effects import STANDARD_LIBRARY
    from pysim.io import read_dataset, write_file
    from pysim.report.diagnosis import diagnosis_data, diagnosis_text

    if args.json:
        prepare_file(args.json, "--json")
    if args.output:
        prepare_folder(args.output)
    dataset = read_dataset(args.data)
    libraries = [STANDARD_LIBRARY, *args.library]
    model, class_name, notes = _model(args.model, libraries)
    catalogue = _catalogue(libraries, args.effects, class_name)
    if class_name and not catalogue:
        notes.append(f"no slot of {class_name} takes an effect of the libraries, so none could be tried")
    makes = _Variants(class_name, libraries) if class_name else None
    free = tuple(name.strip() for name in args.free.split(",") if name.strip())
    given = subject(
        model,
        dataset,
        catalogue,
        makes,
        free=free,
        bounds=bounded(args.bounds),
        overrides=read_parameters(args, model),
        notes=tuple(notes),
    )
    announce_compilation()
    found = diagnose(given, seed=args.seed, most=args.most, progress=_Lines())
    print(diagnosis_text(found))
    files = _write_model(args.output, found, makes) if args.output and makes else {}
    if args.json:
        folder = args.json.resolve().parent
        relative = {name: _relative(path, folder) for name, path in files.items()}
        write_file(args.json, json.dumps(diagnosis_data(found, relative), indent=1, allow_nan=False) + "\n")
    return 0


class _Lines:
    """A line per step with the time since the start, on standard error."""

    def __init__(self) -> None:
        self._begun = time.monotonic()

    def __call__(self, line: str) -> None:
        print(f"{time.monotonic() - self._begun:6.1f} s  {line}", file=sys.stderr, flush=True)


@dataclass
class _Variants:
    """Builds models with effects, each once."""

    class_name: str
    libraries: list[Path]
    built: dict[tuple[str, ...], tuple[Model, dict[str, str]]] = field(default_factory=dict)

    def __call__(self, effects: Sequence[Effect]) -> tuple[Model, dict[str, str]]:
        """The model with these effects, and where they are in it.

        Raises:
            BadInput: a class that cannot be made or does not compile.
        """
        from pysim.types import BadInput

        key = tuple(effect.name for effect in effects)
        if key not in self.built:
            from tempfile import TemporaryDirectory

            import fmu_build

            with TemporaryDirectory(prefix="pysim-variant-") as folder:
                try:
                    self.built[key] = self.write(effects, Path(folder), None)
                except fmu_build.BuildError as error:
                    raise BadInput(str(error)) from error
        return self.built[key]

    def write(
        self, effects: Sequence[Effect], folder: Path, fmu: Path | None, name: str = ""
    ) -> tuple[Model, dict[str, str]]:
        """Write the class into a folder and compile it, into the cache where no place is named.

        Args:
            name: of the class; the base model's with `Variant` behind it where none is given.
        """
        import fmu_build
        from pysim.effects import variant
        from pysim.io import read_model

        name = name or f"{self.class_name.rpartition('.')[2]}Variant"
        made = variant(self.class_name, effects, self.libraries, name=name)
        source = folder / f"{name}.mo"
        source.write_text(made.text, encoding="utf-8")
        built = fmu_build.build(name, fmu, libraries=[*self.libraries, source])
        return read_model(built), made.places


def _model(text: str, libraries: Sequence[Path]) -> tuple[Model, str, list[str]]:
    """The base model, its class where that is known, and notes."""
    from pysim.effects._library import Libraries
    from pysim.io import read_model

    if text.lower().endswith(".fmu"):
        model = read_model(Path(text))
        if model.name in Libraries(libraries).classes:
            return model, model.name, []
        note = f"{model.name} is in none of the libraries, so no effect can be added; name its library with --library"
        return model, "", [note]
    import fmu_build

    return read_model(fmu_build.build(text, libraries=list(libraries))), text, []


def _catalogue(libraries: Sequence[Path], wanted: str, class_name: str) -> tuple[Effect, ...]:
    """Effects of the libraries that the class takes; all where it is not known. Those wanted, where any are named."""
    from pysim.effects import fitting, read_catalogue
    from pysim.types import BadInput

    catalogue = read_catalogue(*libraries)
    taken = fitting(catalogue, class_name, libraries) if class_name else catalogue
    names = [name.strip() for name in wanted.split(",") if name.strip()]
    known, fit = [effect.name for effect in catalogue], [effect.name for effect in taken]
    for name in names:
        if name not in known:
            raise BadInput(f"--effects {name}: not in the catalogue; it has {', '.join(known)}")
        if name not in fit:
            raise BadInput(f"--effects {name}: no slot of {class_name} takes it; its slots take {', '.join(fit)}")
    return tuple(effect for effect in taken if not names or effect.name in names)


def _write_model(folder: Path, found: Diagnosis, makes: _Variants) -> dict[str, Path]:
    """The extended class and its FMU; name -> path."""
    if not found.added:
        return {}
    name = f"{makes.class_name.rpartition('.')[2]}With" + "And".join(
        one.effect.class_name.rpartition(".")[2] for one in found.added
    )
    fmu = folder / f"{name}.fmu"
    makes.write([one.effect for one in found.added], folder, fmu, name)
    values = [f'"{e.name}" = {e.value!r}' for e in found.parameters]
    (folder / "parameters.toml").write_text("\n".join([*values, ""]), encoding="utf-8")
    return {"modelica": folder / f"{name}.mo", "fmu": fmu, "parameters": folder / "parameters.toml"}


def _relative(path: Path, folder: Path) -> str:
    import os

    return Path(os.path.relpath(path.resolve(), folder)).as_posix()
