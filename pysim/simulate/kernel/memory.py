"""The memory that a solver works in."""

from __future__ import annotations

from typing import Any

import numpy as np

from pysim.simulate.kernel.library import address, kernel


def work_arrays(n: int, m: int, stages: int, terms: int, implicit: bool) -> dict[str, Any]:
    """What `Work` of the kernel points to, for n states and m event indicators."""
    square = (n, n) if implicit else (0, 0)
    scratch = _scratch(
        {
            **dict.fromkeys(("x", "dx", "x_new", "x_try", "error", "slope"), (n,)),
            "k": (stages + 1, n),
            "dense": (terms, n),
            **dict.fromkeys(("z", "z_new", "z_try", "z_low"), (m,)),
            "jacobian": square,
        }
    )
    return {
        "n": n,
        "m": m,
        "sums": kernel().row_sums,
        **scratch,
        "scratch_size": scratch["scratch"].size,
        "dx_new": scratch["k"][stages],
        "nominal": np.ones(n),
        "matrix": np.zeros(square),
        "pivots": np.zeros(n, dtype=np.int64),
        "stages": np.zeros((stages, n)),
        "right": np.zeros(n),
        **{name: np.zeros(n) for name in ("pivot_values", "tried_pivots", "probe", "magnitude")},
        "factors": np.zeros(square),
    }


def lined(*shape: int) -> np.ndarray:
    """Zeros that begin with a line of memory, 64 bytes: a row that lies across two is read in twice the time."""
    count = int(np.prod(shape))
    room = np.zeros(count + 8)
    return room[-address(room) % 64 // 8 :][:count].reshape(shape)


def _scratch(shapes: dict[str, tuple[int, ...]]) -> dict[str, Any]:
    """Arrays of these shapes, zero, one after the other in `scratch`, which clears them all at once."""
    ends = np.cumsum([0, *(int(np.prod(shape)) for shape in shapes.values())])
    scratch = np.zeros(ends[-1])
    views = {
        name: scratch[first:last].reshape(shape)
        for (name, shape), first, last in zip(shapes.items(), ends[:-1], ends[1:], strict=True)
    }
    return {"scratch": scratch, **views}
