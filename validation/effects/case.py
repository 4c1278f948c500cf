"""Any two effects build together, vanish together, and run together."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations
from pathlib import Path

import numpy as np

import fmu_build
from fmu_build.errors import BuildError
from pysim.effects import STANDARD_LIBRARY as LIBRARY
from pysim.effects import Variant, fitting, read_catalogue, variant
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.types import Effect, Experiment, Model, Outcome, Record, Signal
from validation.findings import Finding

BASE = "HydraulicTestBench.Pump.FreeGreyBox"
SOLVER = Rodas(rtol=1e-6, atol=1e-6)
STOP = 1.0  # s
ON = {"valve.saturation": 12.0, "valve.rate_limit": 0.5}  # strengths that bite here; the others' nominal ones do


def run() -> Iterator[Finding]:
    """All 153 pairs of the 18 effects, at the free parameter set."""
    effects = fitting(read_catalogue(LIBRARY), BASE, [LIBRARY])
    base = _ran(read_model(fmu_build.build(BASE)), {})
    refused: list[str] = []
    stopped: list[str] = []
    idle: list[str] = []
    exact = shrunk = 0.0
    count = 0
    with tempfile.TemporaryDirectory() as folder:
        for pair in combinations(effects, 2):
            count += 1
            name = " + ".join(effect.name for effect in pair)
            made = variant(BASE, pair, [LIBRARY], name="Both")
            try:
                model = _built(made, Path(folder))
            except BuildError as error:
                refused.append(f"{name}: {error}")
                continue
            off = _largest(_ran(model, _settings(made, pair, on=False)), base)
            if any(effect.bypass for effect in pair):
                shrunk = max(shrunk, off)
            else:
                exact = max(exact, off)
            both = _ran(model, _settings(made, pair, on=True))
            if both.outcome is not Outcome.DONE or not np.isfinite(both.values).all():
                stopped.append(name)
            elif _largest(both, base) < 1e-3:
                idle.append(name)
    yield Finding(f"pairs of {count} that do not build{_names(refused)}", float(len(refused)), 0, "")
    yield Finding("both off: largest difference from the base model's angle", exact, 2e-3, "percent", regression=True)
    yield Finding("both off, one of them by a limit: the same", shrunk, 0.1, "percent", regression=True)
    yield Finding(f"both on: pairs whose run stops early{_names(stopped)}", float(len(stopped)), 0, "")
    yield Finding(f"both on: pairs that change nothing{_names(idle)}", float(len(idle)), 0, "")


def _built(made: Variant, folder: Path) -> Model:
    source = folder / f"{made.class_name}.mo"
    source.write_text(made.text, encoding="utf-8")
    return read_model(fmu_build.build(made.class_name, folder / "pair.fmu", libraries=[source]))


def _settings(made: Variant, pair: Sequence[Effect], *, on: bool) -> dict[str, float]:
    """Of both effects' strengths."""
    values = {}
    for effect in pair:
        for parameter in effect.strengths:
            size = ON.get(effect.name, parameter.nominal) if on else parameter.off
            values[made.parameter(effect.name, parameter.name)] = float(size or 0.0)
    return values


def _ran(model: Model, values: Mapping[str, float]) -> Record:
    """A sine of 4 Hz around an offset, begun smoothly."""
    knots = np.arange(0.0, STOP + 0.01, 0.005)
    swing = (1 - np.exp(-knots / 0.05)) * (15 + 30 * np.sin(2 * np.pi * 4 * knots))
    inputs = {"alphaCMD": Signal.through(knots, swing)}
    times = np.arange(0.0, STOP, 0.004)
    experiment = Experiment(times, ("alphaPercent", "u"), inputs, dict(values), rates={"alphaCMD_t": "alphaCMD"})
    return simulate(model, experiment, solver=SOLVER, check=False)


def _largest(record: Record, base: Record) -> float:
    if record.outcome is not Outcome.DONE:
        return float("nan")
    return float(np.abs(record["alphaPercent"] - base["alphaPercent"]).max())


def _names(names: Sequence[str]) -> str:
    return f" ({'; '.join(names[:5])})" if names else ""
