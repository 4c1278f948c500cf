"""bench-01, whose plant shares no code with ours and misses no effect, is fitted to its noise."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from pysim.identify.greybox import fit, problem
from pysim.io import read_dataset
from pysim.thesis import pump_model
from pysim.types import Fit, FitOutcome
from validation.findings import Finding

FOLDER = Path(__file__).parents[1] / "measurements"
NAMES = ("omega_v", "zeta_v", "L", "A_p", "V_0", "m_eff", "k", "b", "K_p", "K_D", "T_d", "K_L", "tau")
NEAR = 0.03  # share by which a residual may be off the noise


def run() -> Iterator[Finding]:
    """All 13 parameters from the thesis' values."""
    model = pump_model("free")
    truth = _truth()
    found = fit(problem(model, [read_dataset(FOLDER / "bench-01")], NAMES))
    yield Finding("the search converged, off by", float(found.outcome is not FitOutcome.CONVERGED), 0, "")
    yield from _to_the_noise(found)
    exact = [d for d in found.undetermined if not math.isfinite(d.spread)]
    yield Finding("exact null directions beyond the one that is there", abs(len(exact) - 1.0), 0, "")
    yield from _truth_inside(found, truth)


def _truth() -> dict[str, float]:
    values = json.loads((FOLDER / "bench-01.truth.json").read_text(encoding="utf-8"))["parameters"]
    return {("K_D" if name == "K_d" else name): float(value) for name, value in values.items()}


def _to_the_noise(found: Fit) -> Iterator[Finding]:
    for use in ("fit", "validate"):
        sizes = [rms for r in found.records if r.use == use and not r.harmonics for rms in r.rms.values()]
        sines = [rms for r in found.records if r.use == use and r.harmonics for rms in r.rms.values()]
        if sines:
            sizes.append(float(np.sqrt(np.mean(np.square(sines)))))
        worst = max(abs(size - 1) for size in sizes)
        yield Finding(f"records of use {use}: residual over noise is 1, off by at worst", worst, NEAR, "")


def _truth_inside(found: Fit, truth: dict[str, float]) -> Iterator[Finding]:
    """Of what is determined: 0 for inside, else by how many half widths the truth is beyond."""
    determined = [e for e in found.estimates if e.determined and not e.at]
    outside = [e.name for e in determined if not e.interval[0] <= truth[e.name] <= e.interval[1]]
    for e in found.combinations:
        value = math.prod(truth[name] ** power for name, power in e.exponents.items())
        outside += [] if e.interval[0] <= value <= e.interval[1] else [e.name]
    count = len(determined) + len(found.combinations)
    # 5 percent of honest intervals miss; more than two of eleven would happen once in 65 times
    title = f"truths outside the 95 percent intervals, of {count}{': ' + ', '.join(outside) if outside else ''}"
    yield Finding(title, float(len(outside)), 2, "")
