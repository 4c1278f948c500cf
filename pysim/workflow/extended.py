"""The model a step ends with, for the user to take away: its fitted values, and with effects also class and FMU."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping, Sequence
from pathlib import Path

from pysim.io import shown_unit, toml_key, toml_table, write_file
from pysim.present.diagnosis.words import limits_sentence
from pysim.present.notes import listed
from pysim.types import Dataset, Diagnosis, Effect, LearnedLaw
from pysim.workflow.learned import law_file, with_laws
from pysim.workflow.session import SessionParts
from pysim.workflow.shell import quoted
from pysim.workflow.variants import Variants

PARAMETERS = "parameters.toml"  # the fitted values
_WIDTH = 110


def write_extended(found: Diagnosis, parts: SessionParts, folder: Path) -> dict[str, Path]:
    """Write the fitted values, and the class and its FMU where effects or laws were added; name -> path, none without a
    refit.

    Nothing of the user's files is changed: the class extends theirs. Copies of those that it needs come along.

    Raises:
        BadInput: the folder cannot be written.
    """
    fitted = {e.name: e.value for e in found.estimates if "@" not in e.name}
    files: dict[str, Path] = {}
    effects, variants = ([], None) if parts.variants is None else with_laws(found, parts.variants, folder)
    if effects and variants is not None:
        name = extended_name(variants.class_name, [effect.class_name for effect in effects])
        states, fmu = parts.model.abilities.states, folder / f"{name}.fmu"
        values = {key: value for key, value in {**parts.overrides, **fitted}.items() if key not in states}
        inside = [law for law in found.learned if folder / law_file(law) in variants.libraries]
        needs = needed(variants, effects)
        copies = copied(needs, folder, f"{name}.mo")
        comment = _comment(found, parts, [f"{name}.mo", *(copies.get(one, one).name for one in needs)], inside)
        variants.write(effects, folder, fmu, name, values, comment)
        files = {"modelica": folder / f"{name}.mo", "fmu": fmu, **{copy.stem: copy for copy in copies.values()}}
        about = f"{name}, the class in {name}.mo, fitted to data set {parts.dataset.name}."
    else:
        set_ = ", ".join(f"{name} = {float(value)!r}" for name, value in parts.overrides.items())
        held = f"They hold with what was set: {set_}." if set_ else ""
        about = f"{parts.model_name}, refitted to data set {parts.dataset.name}. {held}"
    for k, law in enumerate(law for law in found.learned if law.modelica):
        key = "learned" if k == 0 else f"learned_{k + 1}"
        files[key] = folder / law_file(law)
        if files.pop(files[key].stem, None) is None:
            write_file(files[key], law.modelica)
    if fitted:
        files["parameters"] = folder / PARAMETERS
        write_file(files["parameters"], parameters_text(f"Of {about}", fitted))
    return files


def needed(variants: Variants, effects: Sequence[Effect]) -> list[Path]:
    """The user's libraries that hold a class which the model or an effect names, or which those name."""
    from fmu_build.text import Libraries
    from fmu_build.text.libraries import files_of
    from pysim.effects import STANDARD_LIBRARY

    libraries = Libraries([one for one in variants.libraries if one != STANDARD_LIBRARY])
    roots = map(libraries.full, (variants.class_name, *(effect.class_name for effect in effects)))
    used = {one.source.file for root in roots if root is not None for one in libraries.named(root)}
    return [one for one in libraries.places if any(file in used for file, _ in files_of(one))]


def copied(libraries: Sequence[Path], folder: Path, *taken: str) -> dict[Path, Path]:
    """Copy the libraries that are one file into a folder; library -> its copy, with a number where its name is taken.

    Args:
        taken: names of files that will lie there too.
    """
    names, copies = {name.casefold() for name in taken}, {}
    files = [one for one in libraries if one.is_file()]
    for one in sorted(files, key=lambda one: one.parent != folder):  # what lies there already keeps its name
        tries = (one.name, *(f"{one.stem}-{k}{one.suffix}" for k in range(2, len(files) + len(taken) + 1)))
        name = next(name for name in tries if name.casefold() not in names)
        names.add(name.casefold())
        copies[one] = folder / name
        write_file(folder / name, one.read_bytes())
    return copies


def parameters_text(about: str, values: Mapping[str, float]) -> str:
    """Lines NAME = VALUE as `--parameters` takes them, below a comment."""
    plain = "".join(c if c.isprintable() else " " for c in about)  # a line break would end the comment
    head = textwrap.wrap(plain, _WIDTH, initial_indent="# ", subsequent_indent="# ")
    return toml_table("\n".join(head), {toml_key(name): float(value) for name, value in values.items()})


def extended_name(base: str, effects: Sequence[str]) -> str:
    """`PumpWithDeadbandAndFriction` of the last words of the classes' names."""
    return f"{_last(base)}With{'And'.join(_last(name) for name in effects)}"


def _last(name: str) -> str:
    return name.rpartition(".")[2]


def _comment(found: Diagnosis, parts: SessionParts, places: Sequence[str], laws: Sequence[LearnedLaw]) -> str:
    """What it is, from which data, and when not to trust it.

    Args:
        places: file of the class, and names of the libraries that it needs.
        laws: learned ones that are in it.
    """
    name, inside = Path(places[0]).stem, {law.slot for law in laws}
    build = quoted(["fmu-build", name, *(word for one in places for word in ("--library", one))])
    added = [one.effect.name for one in found.effects]
    added += [f"a learned law at {law.slot} over {law.argument}" for law in laws]
    paragraphs = [
        f"{name}: {parts.model_name} with {', '.join(added)}.",
        f"Every number below was fitted to the records of data set {parts.dataset.name} that are marked fit; intervals "
        "and evidence are in report.html beside this file.",
        *([f"It needs {listed(places[1:])}."] if places[1:] else []),
        f"Compiles where these lie by: {build}",
        "Do not trust it",
        *(
            f"- as the fitted model: it lacks the learned law at {law.slot}"
            for law in found.learned
            if law.slot not in inside
        ),
        *(f"- {text}" for text in _limits(found, parts)),
    ]
    indent = {True: "  ", False: ""}
    wrapped = [
        p if build in p else textwrap.fill(p, _WIDTH, subsequent_indent=indent[p.startswith("-")]) for p in paragraphs
    ]  # a command is pasted, and stays on its line
    return "\n".join(wrapped)


def _limits(found: Diagnosis, parts: SessionParts) -> list[str]:
    """What the data did not show."""
    texts = [f"beyond what was excited: {_excited(parts.dataset)}"]
    if not any(record.held_out for record in parts.dataset.records):
        texts.append("for other excitation without a test: every record was fitted")
    last = found.history[-1] if found.history else None
    if last is not None and last.criteria and not last.passes:
        texts.append(f"as a match by the thesis' limits: {limits_sentence(last)}".removesuffix("."))
    if not found.complete:
        texts.append("as complete: more than noise is left, and what that is could not be named")
    elif found.learned:
        texts.append("as an explanation: nothing but noise is left, but what causes the learned law has no name")
    for group in found.ties:
        texts.append(f"as proof of the effect's kind: these data cannot tell {', '.join(group)} apart")
    for direction in last.undetermined if last is not None else ():
        names = ", ".join(direction.exponents)
        texts.append(f"as to {names} one by one: the data tell only products of them")
    return texts


def _excited(dataset: Dataset) -> str:
    """Ranges of the inputs in logs that were fitted, and the frequencies of stepped sines among these."""
    ranges: dict[str, tuple[float, float]] = {}
    fitted = [record for record in dataset.records if record.use == "fit"]
    for record in fitted:
        for name in dataset.columns(record, "input"):
            values = record.data[name]  # type: ignore[index]
            low, high = ranges.get(name, (float("inf"), -float("inf")))
            ranges[name] = (min(low, float(values.min())), max(high, float(values.max())))
    texts = []
    for name, (low, high) in ranges.items():
        unit, factor = shown_unit(dataset.signal(name).unit)
        texts.append(f"{name} from {factor * low:.4g} to {factor * high:.4g} {unit}")
    sines = [record.frequency for record in fitted if record.frequency is not None]
    texts += [f"sines from {min(sines):g} to {max(sines):g} Hz"] if sines else []
    return "; ".join(texts) or "see the data set"
