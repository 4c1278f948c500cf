"""Why can the locked model not fit, and does the load reach the swash plate? What the published responses say."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from validation.findings import Finding
from validation.real_measurements.explain import Explained, explain
from validation.real_measurements.load import LoadDifference, couplings, load_differences
from validation.real_measurements.reference import reference

# Known numbers that mend the model: the cylinder's area and the valve's opening near its middle.
_RIVALS = ("A_p", "k3")


def run() -> Iterator[Finding]:
    """Every hypothesis, then the load."""
    done = []
    for one in explain(reference()):
        print(one, flush=True)
        done.append(one)
    yield from _locked(done)
    yield from _load()


def _locked(done: Sequence[Explained]) -> Iterator[Finding]:
    by_name = {one.hypothesis.name: one for one in done}
    locked, area, valve = (by_name[name] for name in ("locked", *_RIVALS))
    effects = [one for one in done if one.hypothesis.kind == "effect"]
    best = min(effects, key=lambda one: one.misfit)
    yield Finding("the locked model fits: the reference's own misfit over its", 1 / locked.misfit, 0.67, "")
    yield Finding("with the area free it does not: misfit", area.misfit, 1.2, "of the reference's own")
    yield Finding("with the area free: tests of nine beyond Table 1.3", 9.0 - area.passes, 0, "")
    yield Finding("with the valve's k3 free it does not: misfit", valve.misfit, 1.0, "of the reference's own")
    yield Finding("with the valve's k3 free: tests of nine beyond Table 1.3", 9.0 - valve.passes, 0, "")
    yield Finding("with the valve's k3 free a parameter stands at a bound", float(len(valve.bent)), 0, "")
    claim = f"an effect of the catalogue does better than k3, the best being {best.hypothesis.name}: misfits"
    yield Finding(claim, valve.misfit / best.misfit, 1.0, "as ratio")


def _load() -> Iterator[Finding]:
    differences = load_differences()
    for found in couplings(differences):
        change = f"{found.change:+.3g} {found.unit}" + (f" of {found.value:.3g}" if found.value else "")
        print(f"load: {found.name:18} explains {100 * found.share:3.0f} % alone, by {change}", flush=True)
    for one in differences:
        test = f"75/{one.amplitude:g}, loaded less unloaded"
        yield Finding(f"{test}: mean gain over the reference's own misfit", _mean(one, one.db, one.mean_db), 1.0, "")
        yield Finding(f"{test}: mean phase over the reference's own misfit", _mean(one, one.deg, one.mean_deg), 1.0, "")


def _mean(one: LoadDifference, values: np.ndarray, size: float) -> float:
    return float(np.mean(np.abs(values))) / size
