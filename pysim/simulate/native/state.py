"""What the native loop keeps between two calls, and the memory it works in."""

from __future__ import annotations

from typing import Any

import numpy as np

# How a run stands: in the order of pysim.types.Outcome, or still running.
RUNNING = -1
DONE, STEP_TOO_SMALL, NOT_FINITE, MODEL_ERROR, TERMINATED, TOO_MANY_STEPS, TOO_MANY_EVENTS = range(7)

# Step rule: the part of a solver's settings that every method shares.
CONTROL = np.dtype(
    [
        ("step", np.float64),  # s, fixed step; 0 where the error rules
        ("rtol", np.float64),  # tolerated error of a step, of a state's magnitude
        ("atol", np.float64),  # the same, of a state's nominal value
        ("max_step", np.float64),  # s
        ("max_steps", np.int64),
    ]
)

STATISTICS = ("steps", "rejected", "derivatives", "jacobians", "events")

RUN = np.dtype(
    [
        ("start", np.float64),  # s
        ("end", np.float64),  # s
        ("t", np.float64),  # s, last accepted point
        ("h", np.float64),  # s, step to try next
        ("error_before", np.float64),  # norm of the last accepted step
        ("grid", np.int64),  # fixed step: number of the last grid point reached
        ("segment", np.int64),  # number of the next break; -1 before the run has begun
        ("horizon", np.float64),  # s, time of that break: inputs are smooth up to here
        ("inputs_at", np.float64),  # s, of the values that the FMU has; NaN where it has none of this segment
        ("next_event", np.float64),  # s, the model's next time event
        ("offset_at", np.float64),  # s, when the states are offset, at a break; NaN: never
        ("offset", np.int64),  # (n,) what is added to them
        ("leaves", np.float64),  # s, time events from here on are left to who drives the run
        ("status", np.int64),  # worst status of an FMI function so far
        ("crowd", np.int64),  # events since time last moved on
        ("jacobian_at", np.float64),  # s, where the Jacobian was taken; NaN where it was not
        ("matrix_step", np.float64),  # s, step for which it was factorised; 0 where it was not
        ("is_sparse", np.int64),  # 1: the factors last made are those of `elimination`
        *((name, np.int64) for name in STATISTICS),
    ]
)

# Addresses; n states, m event indicators, s stages, d coefficients of the interpolant.
WORK = np.dtype(
    [
        ("n", np.int64),
        ("m", np.int64),
        ("scratch", np.int64),  # what must not tell a run of the one before, in one piece
        ("x", np.int64),  # (n,) at run.t
        ("dx", np.int64),  # (n,) derivative there
        ("x_new", np.int64),  # (n,) at the end of the step
        ("dx_new", np.int64),  # (n,) derivative there: the last row of k
        ("x_try", np.int64),  # (n,) where a stage or an interpolation looks
        ("k", np.int64),  # (s + 1, n) stages
        ("error", np.int64),  # (n,)
        ("dense", np.int64),  # (d, n) coefficients of theta, theta^2, ...
        ("nominal", np.int64),  # (n,)
        ("z", np.int64),  # (m,) event indicators at run.t
        ("z_new", np.int64),  # (m,) at the end of the step
        ("z_try", np.int64),  # (m,)
        ("z_low", np.int64),  # (m,) at the lower end of a search
        ("jacobian", np.int64),  # (n, n) row j: derivatives by state j
        ("matrix", np.int64),  # (n, n) factorised
        ("pivots", np.int64),  # (n,) of int64
        ("slope", np.int64),  # (n,) partial derivative of dx by time
        ("stages", np.int64),  # (s, n) states of the stages, where those are unknowns
        ("right", np.int64),  # (n,) what is known of such a stage
        ("has_directional", np.int64),
        ("ones", np.int64),  # (n,) seed of a directional derivative
        ("derivative_references", np.int64),  # (n,) of uint32
        ("groups", np.int64),  # of states whose columns one directional derivative yields
        ("group_first", np.int64),  # (groups + 1,) of int64, group g owns the members group_first[g]:group_first[g + 1]
        ("group_members", np.int64),  # (n,) of int64, numbers of states
        ("group_references", np.int64),  # (n,) of uint32, of the members
        # Group g yields the entries entry_first[g]:entry_first[g + 1], those that may differ from zero.
        ("entry_first", np.int64),  # (groups + 1,) of int64
        ("entry_references", np.int64),  # of uint32, of the derivatives
        ("entry_places", np.int64),  # of int64, in `jacobian`
        # Sparse elimination: entries (n_e,) row after row, rows and columns in the order of elimination.
        ("sparse", np.int64),  # 0: dense elimination only, and nothing of what follows
        ("entries", np.int64),  # n_e
        ("sources", np.int64),  # (n_e,) of int64, place in `jacobian`
        ("states", np.int64),  # (n,) of int64, state of a row
        ("row_first", np.int64),  # (n + 1,) of int64, row r owns the entries row_first[r]:row_first[r + 1]
        ("diagonal", np.int64),  # (n,) of int64, entry on the diagonal
        ("places", np.int64),  # (n_e,) of int64, column
        ("columns", np.int64),  # (n_e,) of int64, state of the column
        ("targets", np.int64),  # of int64, entries that elimination changes, one after the other
        ("eliminate", np.int64),  # machine code for this pattern; 0: the loops serve
        ("substitute", np.int64),
        ("factors", np.int64),  # (n, n), of which the first n_e are used
        ("pivot_values", np.int64),  # (n,)
        ("probe", np.int64),  # (n,)
    ]
)


def work_arrays(n: int, m: int, stages: int, terms: int, implicit: bool) -> dict[str, Any]:
    """What WORK points to, for n states and m event indicators."""
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
        **scratch,
        "dx_new": scratch["k"][stages],
        "nominal": np.ones(n),
        "matrix": np.zeros(square),
        "pivots": np.zeros(n, dtype=np.int64),
        "stages": np.zeros((stages, n)),
        "right": np.zeros(n),
        **{name: np.zeros(n) for name in ("pivot_values", "probe")},
        "factors": np.zeros(square),
        "ones": np.ones(n),
    }


def _scratch(shapes: dict[str, tuple[int, ...]]) -> dict[str, Any]:
    """Arrays of these shapes, zero, one after the other in `scratch`, which clears them all at once."""
    ends = np.cumsum([0, *(int(np.prod(shape)) for shape in shapes.values())])
    scratch = np.zeros(ends[-1])
    views = {
        name: scratch[first:last].reshape(shape)
        for (name, shape), first, last in zip(shapes.items(), ends[:-1], ends[1:], strict=True)
    }
    return {"scratch": scratch, **views}
