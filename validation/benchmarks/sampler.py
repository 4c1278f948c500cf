"""Which library the processor is in, sampled over a call: Linux only, built with the C compiler that comes along."""

from __future__ import annotations

import ctypes
import subprocess
import sys
import tempfile
from bisect import bisect_right
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import numpy as np

_SOURCE = Path(__file__).with_name("sampler.c")
_TICK_US, _ROOM = 1000, 2_000_000
_GENERATED = "generated code"  # memory that belongs to no file: what Numba compiled


def sampled(call: Callable[[], object]) -> Counter[str]:
    """Ticks of this process' CPU time by the file whose code ran, all threads together.

    Raises:
        LookupError: not on this system.
    """
    if not sys.platform.startswith("linux"):
        raise LookupError("the sampler reads /proc/self/maps, which Linux alone has")
    with tempfile.TemporaryDirectory() as folder:
        library = _built(Path(folder))
        places = np.zeros(_ROOM, dtype=np.uint64)
        if library.sampler_start(ctypes.c_void_p(places.ctypes.data), ctypes.c_long(_ROOM), ctypes.c_long(_TICK_US)):
            raise LookupError("this system has no timer of processor time")
        try:
            call()
        finally:
            count = library.sampler_stop()
        return _by_file(places[:count])


def _built(folder: Path) -> ctypes.CDLL:
    file = folder / "sampler.so"
    words = [sys.executable, "-m", "ziglang", "cc", "-O2", "-shared", "-fPIC", "-o", str(file), str(_SOURCE)]
    subprocess.run(words, check=True, capture_output=True)
    library = ctypes.CDLL(str(file))
    library.sampler_stop.restype = ctypes.c_long
    return library


def _by_file(places: np.ndarray) -> Counter[str]:
    rows = []
    for line in Path("/proc/self/maps").read_text().splitlines():
        span, _, _, _, _, *file = line.split(maxsplit=5)
        first, last = (int(end, 16) for end in span.split("-"))
        rows.append((first, last, file[0] if file else _GENERATED))
    starts = [first for first, _, _ in rows]
    found: Counter[str] = Counter()
    for place in places.tolist():
        first, last, name = rows[max(bisect_right(starts, place) - 1, 0)]
        found[name if first <= place < last else _GENERATED] += 1
    return found
