"""Python's share of a whole fit: processor time in the interpreter, in NumPy's own code and in the C library."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping

from validation.benchmarks import pump_fit
from validation.benchmarks.measurement import Measurement
from validation.benchmarks.sampler import sampled

AIM = 0.10
# The first that matches the name of the file whose code runs. All else is the simulation's: FMUs, the loop around them
# (be it compiled by Numba or a library), and the mathematical functions they call. The C library copies memory and
# waits for locks; it counts as Python's, though some of it serves the simulation.
PARTS: Mapping[str, str] = {
    "linear algebra": r"openblas|lapack|libmkl|_umath_linalg|_flapack|_fblas|cython_(blas|lapack)",
    "Python": r"/python[\d.]*$|libpython|\.cpython-|site-packages/(numpy|scipy)|/libc[.-]|/ld-linux|libpthread|\[vdso",
}
_SIMULATION = "simulation"


def measure(pairs: int) -> Iterator[Measurement]:
    """Each run is sampled a thousand times a second of processor time, or as often as the system's clock ticks."""
    data = pump_fit.dataset()
    pump_fit.warm_up()
    ticks: Counter[str] = Counter()
    try:
        for _ in range(pairs):
            ticks += by_part(sampled(lambda: pump_fit.whole_fit(data)))
    except LookupError as missing:
        yield Measurement("Python's share of a whole fit", float("nan"), AIM, skipped=str(missing))
        return
    total = ticks.total()
    yield Measurement(f"Python's share of a whole fit, {total} samples", ticks["Python"] / total, AIM)
    for part in ("linear algebra", _SIMULATION):
        yield Measurement(f"of it in {part}", ticks[part] / total)


def by_part(files: Mapping[str, int]) -> Counter[str]:
    """Ticks by part, of ticks by file."""
    found: Counter[str] = Counter()
    for name, count in files.items():
        part = next((part for part, pattern in PARTS.items() if re.search(pattern, name)), _SIMULATION)
        found[part] += count
    return found
