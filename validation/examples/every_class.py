"""Every model and block of the library compiled: alone where it can stand alone, inside another where it cannot.

Each state needs a nominal value: an importer multiplies its tolerance by it, and the 1 that stands for a missing one
may be far off. An effect is not asked: its signal has the size of the slot that it fills.
"""

from __future__ import annotations

import re
import tempfile
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path

import fmu_build
from fmu_build.build import bundled_library
from pysim.effects import STANDARD_LIBRARY, fitting, read_catalogue, variant
from pysim.io import read_model
from pysim.types import Effect, Model
from validation.findings import Finding

BASES = ("HydraulicTestBench.Pump.FreeGreyBox", "HydraulicTestBench.LoadCircuit.OpenTestBench")

SHARED_SLOTS = (("valve.rate_limit", "valve.saturation"),)  # two effects that a class of their own joins
# What a class says that needs surroundings: values for its parameters, or something at its connectors.
_NEEDS = re.compile(
    r"has no value|the system is singular|has open connectors|would need the derivative of the input|"
    r"initial condition"
)
_NEEDS_SIZES = re.compile(r"unresolved component dimension")


def run() -> Iterator[Finding]:
    """How many compile alone, that no other is in none of them, and that each of their states has a scale."""
    alone, others, refused = _compiled()
    for name, why in refused.items():
        yield Finding(f"{name} does not compile: {why}", 1.0, 0.0, "")
    inside = used_by([*alone]) | in_slots(set(others))
    left = sorted(set(others) - inside)
    claim = f"{len(alone)} models compile alone, {len(others)} inside these or in the slots they are for"
    yield Finding(claim, float(len(left)), 0.0, "in none")
    for name in left:
        yield Finding(f"{name} is in none that compiles: {others[name]}", 1.0, 0.0, "")
    asked = [fmu for name, fmu in alone.items() if ".Effects." not in name]
    unscaled = [state for fmu in asked for state in without_a_scale(read_model(fmu))]
    yield Finding("states of these without a nominal value", float(len(unscaled)), 0.0, "")
    for state in unscaled:
        yield Finding(f"{state} has no nominal value", 1.0, 0.0, "")


def without_a_scale(model: Model) -> list[str]:
    """States for which the FMU says no nominal value."""
    return [f"{model.name}.{name}" for name in model.abilities.states if model[name].nominal is None]


def _compiled() -> tuple[dict[str, Path], dict[str, str], dict[str, str]]:
    """FMUs of those that compile; names of those that need surroundings and that fail otherwise, with the reason."""
    alone: dict[str, Path] = {}
    others: dict[str, str] = {}
    refused: dict[str, str] = {}
    for name in models():
        try:
            alone[name] = fmu_build.build(name)
        except fmu_build.BuildError as error:
            needy = _NEEDS.search(error.message) or _NEEDS_SIZES.search(error.message)
            (others if needy else refused)[name] = str(error)
    return alone, others, refused


def models() -> list[str]:
    """Every model and block that is neither partial nor an icon."""
    kinds = {name: re.search(r"^(partial )?(\w+) ", text, re.MULTILINE) for name, text in _texts().items()}
    return [
        name
        for name, kind in kinds.items()
        if kind and not kind[1] and kind[2] in ("model", "block") and ".Icons." not in name
    ]


def used_by(names: list[str]) -> set[str]:
    """All classes that these name in their declarations, and those in turn."""
    found, to_read = set(names), list(names)
    while to_read:
        new = _named(to_read.pop()) - found
        found |= new
        to_read += new
    return found


def in_slots(wanted: set[str]) -> set[str]:
    """Those of the classes that compile in a slot of the pump or of the test bench, alone or with another effect."""
    found: set[str] = set()
    for base in BASES:
        effects = fitting(read_catalogue(STANDARD_LIBRARY), base, [STANDARD_LIBRARY])
        names = {effect.name for effect in effects}
        choices = [{effect.name} for effect in effects if effect.class_name in wanted]
        choices += [set(pair) for pair in SHARED_SLOTS if set(pair) <= names]
        for choice in choices:
            found |= _classes_of(base, [effect for effect in effects if effect.name in choice])
    return found


def _classes_of(base: str, effects: list[Effect]) -> set[str]:
    """Classes named in a variant with the effects; none where it does not compile."""
    made = variant(base, effects, [STANDARD_LIBRARY], name="Filled")
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / f"{made.class_name}.mo"
        file.write_text(made.text, encoding="utf-8")
        try:
            fmu_build.build(made.class_name, libraries=[file])
        except fmu_build.BuildError:
            return set()
    return {word for word in re.findall(r"[A-Z]\w*(?:\.[A-Za-z]\w*)*", made.text) if word in _texts()}


@cache
def _texts() -> Mapping[str, str]:
    """Sources without strings, comments and their first line, by full name."""
    library = bundled_library()
    texts = {}
    for file in sorted(library.rglob("*.mo")):
        parts = file.relative_to(library).with_suffix("").parts
        name = ".".join((library.name, *(part for part in parts if part != "package")))
        texts[name] = _bare(file)
    return texts


def _bare(file: Path) -> str:
    source = re.sub(r'"(?:\\.|[^"\\])*"|//[^\n]*', "", file.read_text(encoding="utf-8"))
    return source.partition("\n")[2]


def _named(name: str) -> set[str]:
    """Classes of the library that the class's text names, each looked up from inside outwards."""
    texts, found = _texts(), set()
    scopes = name.split(".")
    for word in set(re.findall(r"\b[A-Z]\w*(?:\.[A-Za-z]\w*)*", texts[name])):
        for depth in range(len(scopes), 0, -1):
            full = ".".join([*scopes[:depth], word])
            if full in texts:
                found.add(full)
                break
    return found
