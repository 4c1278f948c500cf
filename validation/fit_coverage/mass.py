"""How often intervals hold the truth over many fits of a fast model: white and coloured noise, from rest and in motion.

`python -m validation.fit_coverage.mass [SEEDS]` goes on where an earlier run of the same code stopped.
"""

from __future__ import annotations

import hashlib
import json
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter
from scipy.stats import binomtest

from pysim.identify.greybox import Effort, Parameter, fit, problem
from pysim.types import FitOutcome, Model
from validation import initial_states
from validation.findings import Finding
from validation.initial_states.mass import TRUTH, at_rest, force, logged, mass_model, measured, motion

Array = NDArray[np.float64]

SEEDS, LEVEL, SURE = 400, 0.95, 0.99
STORE = Path(__file__).parents[2] / "results" / "fit-coverage"
TIME = np.arange(801) / 100  # s
NOISE = 1e-3  # m, standard deviation
FURTHEST = (0.05, 0.5)  # m and m/s: a log in motion begins anywhere up to there
_OFF = 0.1  # of the logarithm of each truth: where a fit starts
_PUSHED = 11  # seed of the force, the same in all
_CODE = ("identify", "simulate", "types")  # folders of pysim whose code decides what a fit says


@dataclass(frozen=True)
class Variant:
    """One kind of log.

    Args:
        name: in words.
        memory: correlation of the noise of a sample with that of the one before: 0 is white.
        moves: whether the log begins in motion.
    """

    name: str
    memory: float
    moves: bool


VARIANTS = (
    Variant("white noise, from rest", 0.0, False),
    Variant("white noise, in motion", 0.0, True),
    Variant("coloured noise, from rest", 0.8, False),
    Variant("coloured noise, in motion", 0.8, True),
)


def run() -> Iterator[Finding]:
    """A claim per variant: the binomial interval around the share that holds the truth has 95 percent in it."""
    for variant in VARIANTS:
        yield finding(variant, list(counted(variant, SEEDS)))


def finding(variant: Variant, fits: list[Mapping[str, bool]]) -> Finding:
    """Of its fits, each a hit or a miss by parameter; one that did not converge is all misses."""
    hits, total = sum(sum(one.values()) for one in fits), sum(len(one) for one in fits)
    low, high = binomtest(hits, total).proportion_ci(SURE)
    off = max(0.0, low - LEVEL, LEVEL - high)
    share = f"{100 * hits / total:.1f} percent ({100 * low:.1f} to {100 * high:.1f})"
    claim = f"{variant.name}: {total} intervals of {len(fits)} fits hold the truth in {share}; 95 is outside that by"
    return Finding(claim, 100 * off, 0.0, "%")


def counted(variant: Variant, seeds: int, store: Path = STORE) -> Iterator[Mapping[str, bool]]:
    """Hits of each seed, from the store as far as it goes; what is new is stored at once."""
    file = store / f"{variant.name.replace(', ', '-').replace(' ', '-')}-{code()}.jsonl"
    known = [json.loads(line) for line in file.read_text().splitlines()] if file.is_file() else []
    yield from known[:seeds]
    file.parent.mkdir(parents=True, exist_ok=True)
    model = mass_model()
    for seed in range(len(known), seeds):
        hits = one_fit(model, variant, seed)
        with file.open("a") as lines:
            lines.write(json.dumps(hits) + "\n")
        yield hits


def one_fit(model: Model, variant: Variant, seed: int) -> Mapping[str, bool]:
    """Whether the interval of each parameter holds its truth."""
    rng = np.random.default_rng((seed, VARIANTS.index(variant)))
    begun = tuple(float(rng.uniform(-far, far)) for far in FURTHEST) if variant.moves else (0.0, 0.0)
    pushed = force(TIME, _PUSHED) * (1.0 if variant.moves else np.minimum(TIME, 1.0))
    states = motion(TIME, pushed, (begun[0], begun[1]))
    states[:, 0] += coloured(rng, TIME.size, variant.memory)
    begins = (logged("log", TIME, pushed, states, ("x",)),)
    records = begins if variant.moves else at_rest(begins)
    free = [Parameter(name, start=value * float(np.exp(rng.uniform(-_OFF, _OFF)))) for name, value in TRUTH.items()]
    data = measured("mass", records, {"x": NOISE})
    found = fit(problem(model, [data], free), effort=Effort(nominal=False))
    good = found.outcome is FitOutcome.CONVERGED
    own = (e for e in found.estimates if e.name in TRUTH)
    return {e.name: bool(good and e.interval[0] <= TRUTH[e.name] <= e.interval[1]) for e in own}


def coloured(rng: np.random.Generator, count: int, memory: float) -> Array:
    """Normal noise (count,) of standard deviation NOISE; each sample remembers that share of the one before."""
    fresh = NOISE * rng.standard_normal(count)
    fresh[1:] *= np.sqrt(1 - memory**2)
    return np.asarray(lfilter([1.0], [1.0, -memory], fresh), dtype=np.float64)


def code() -> str:
    """Eight digits that change with the code of the fit and of the data, so that counts of two are never mixed."""
    digest = hashlib.sha256(repr((TRUTH, NOISE, FURTHEST, VARIANTS)).encode())
    root = Path(__file__).parents[2] / "pysim"
    files = [file for folder in _CODE for file in (root / folder).rglob("*") if file.suffix in (".py", ".c")]
    files += [Path(initial_states.__file__).with_name(name) for name in ("mass.py", "Mass.mo")]
    for file in sorted(files):
        digest.update(file.read_bytes())
    return digest.hexdigest()[:8]


def main(seeds: int) -> None:
    """Print each variant as far as it is, every fifty fits."""
    for variant in VARIANTS:
        fits: list[Mapping[str, bool]] = []
        for hits in counted(variant, seeds):
            fits.append(hits)
            if len(fits) % 50 == 0 or len(fits) == seeds:
                print(finding(variant, fits), flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else SEEDS)
