"""A short expression for a missing term, by sparse regression over a small physical library."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# A table follows a law to within this share of its size: it is straight between its knots.
_COARSE = 0.05
# Share of the term that a formula has to give.
_GOOD = 0.9
_WIDTHS = 24


@dataclass(frozen=True)
class Formula:
    """What describes a table best.

    Args:
        text: with numbers and units; "" where nothing does.
        form: word for its kind, "" where nothing does.
        along: (k,) amounts of what refitting absorbs, with which the table and the formula agree.
        spread: (k, k) their covariance.
    """

    text: str
    form: str
    along: Array
    spread: Array


@dataclass(frozen=True)
class _Term:
    """One kind of term: its columns for a size of its own (n, j), and how it is written with amounts (j,) and size."""

    form: str
    sized: bool
    columns: Callable[[Array, float], Array]
    written: Callable[[Array, float, str, str, str], str]


def formula(
    k: Array,
    values: Array,
    covariance: Array,
    absorbed: Array,
    *,
    argument: str,
    unit_in: str,
    unit_out: str,
) -> Formula:
    """The expression with the best information criterion, if one gives nearly the whole term.

    Args:
        k: (m,) where the term is known.
        values: (m,) there, without what refitting absorbs.
        covariance: (m, m) of the values.
        absorbed: (m, a) orthonormal directions in which they may be anything.
        argument, unit_in, unit_out: names and units to write with.
    Source: the criterion is Schwarz 1978, Annals of Statistics 6:461.
    """
    count = absorbed.shape[1]
    nothing = Formula("", "", np.zeros(count), np.zeros((count, count)))
    m, size = k.size, float(np.sqrt(np.mean(values**2)))
    if not size > 0:
        return nothing
    white = _whitener(covariance, _COARSE * size)
    target, free = white @ values, white @ absorbed
    best: tuple[float, _Term, float, Array, Array] | None = None
    for term, width in _tried(k):
        if term.form == "saturation" and unit_in != unit_out:
            continue  # a limited signal is a signal; of forces that saturate the hyperbolic tangent is the smooth form
        if "sign" in term.form and k[0] * k[-1] > 0:
            continue  # nothing changes its sign
        columns = term.columns(k, width)
        if np.linalg.norm(columns - absorbed @ (absorbed.T @ columns)) < 1e-3 * np.linalg.norm(columns):
            continue  # refitting takes all of it
        design = np.column_stack([white @ columns, free])
        amounts: Array = np.linalg.lstsq(design, target, rcond=None)[0].astype(np.float64)
        rest = float(np.sum((target - design @ amounts) ** 2))
        score = rest + (columns.shape[1] + term.sized) * math.log(m)
        if best is None or score < best[0]:
            best = (score, term, width, amounts[: columns.shape[1]], amounts[columns.shape[1] :])
    assert best is not None
    _, term, width, own, along = best
    left = target - white @ term.columns(k, width) @ own - free @ along
    if float(left @ left) > (1 - _GOOD) * float(target @ target) or float(left @ left) > 3 * m:
        return nothing
    design = np.column_stack([white @ term.columns(k, width), free])
    spread: Array = np.linalg.pinv(design.T @ design)[own.size :, own.size :].astype(np.float64)
    text = term.written(own, width, argument, unit_in, unit_out)
    return Formula(text, term.form, -along, spread)


def _whitener(covariance: Array, least: float) -> Array:
    """What makes values independent and of variance 1, (m, m), each with a deviation of its own besides.

    Where the data leave a direction open its variance is so large that others may come out below nothing by rounding.
    """
    sizes, turned = np.linalg.eigh(covariance)
    return np.asarray((turned / np.sqrt(np.maximum(sizes, 0.0) + least**2)) @ turned.T)


def _tried(k: Array) -> Iterator[tuple[_Term, float]]:
    """Every term of the library, with every size of its own worth trying."""
    reach = float(np.max(np.abs(k)))
    near = float(np.min(np.abs(k[k != 0])))
    widths = np.geomspace(max(0.25 * near, 1e-4 * reach), reach, _WIDTHS).tolist()
    for term in _LIBRARY:
        yield from itertools.product([term], widths if term.sized else [0.0])


def _number(value: float, unit: str) -> str:
    return f"{value:.3g}" if unit in ("", "1") else f"{value:.3g} {unit}"


def _per(out: str, unit_in: str, power: int) -> str:
    if out == unit_in and power == 1:
        return "1"
    below = "" if unit_in == "1" else f"({unit_in})" if any(sign in unit_in for sign in "/.") else unit_in
    return out if not below else f"{out}/{below}{power if power > 1 else ''}"


def _saturated(z: Array, w: float) -> Array:
    return np.clip(z, -w, w)[:, None]


def _write_saturation(a: Array, w: float, z: str, unit_in: str, out: str) -> str:
    if out == unit_in and abs(a[0] + 1) < 0.25:
        return f"-limit({z}, +-{_number(w, unit_in)}), a dead band"
    return f"{_number(a[0], _per(out, unit_in, 1))} limit({z}, +-{_number(w, unit_in)})"


_LIBRARY = (
    _Term("constant", False, lambda z, w: np.ones((z.size, 1)), lambda a, w, z, i, o: _number(a[0], o)),
    _Term("linear", False, lambda z, w: z[:, None], lambda a, w, z, i, o: f"{_number(a[0], _per(o, i, 1))} {z}"),
    _Term(
        "square",
        False,
        lambda z, w: (z * np.abs(z))[:, None],
        lambda a, w, z, i, o: f"{_number(a[0], _per(o, i, 2))} {z} abs({z})",
    ),
    _Term("cube", False, lambda z, w: z[:, None] ** 3, lambda a, w, z, i, o: f"{_number(a[0], _per(o, i, 3))} {z}^3"),
    _Term("sign", False, lambda z, w: np.sign(z)[:, None], lambda a, w, z, i, o: f"{_number(a[0], o)} sign({z})"),
    _Term(
        "sign",
        True,
        lambda z, w: np.tanh(z / w)[:, None],
        lambda a, w, z, i, o: f"{_number(a[0], o)} tanh({z}/{_number(w, i)})",
    ),
    _Term("saturation", True, _saturated, _write_saturation),
    _Term(
        "beyond",
        True,
        lambda z, w: z[:, None] - _saturated(z, w),
        lambda a, w, z, i, o: f"{_number(a[0], _per(o, i, 1))} ({z} beyond +-{_number(w, i)})",
    ),
    _Term(
        "sign and fall",
        True,
        lambda z, w: np.column_stack([np.sign(z), np.sign(z) * np.exp(-np.abs(z) / w)]),
        lambda a, w, z, i, o: f"({_number(a[0], o)} + {_number(a[1], o)} exp(-abs({z})/{_number(w, i)})) sign({z})",
    ),
    _Term(
        "falling",
        True,
        lambda z, w: (np.sign(z) / (np.abs(z) + w))[:, None] if np.min(z) > 0 else np.zeros((z.size, 1)),
        lambda a, w, z, i, o: f"{_number(a[0], f'{o} {i}')}/({z} + {_number(w, i)})",
    ),
    _Term(
        "falling",
        True,
        lambda z, w: ((np.abs(z) + w) ** -2.0)[:, None] if np.min(z) > 0 else np.zeros((z.size, 1)),
        lambda a, w, z, i, o: f"{_number(a[0], f'{o} {i}2')}/({z} + {_number(w, i)})^2",
    ),
    _Term(
        "constant and linear",
        False,
        lambda z, w: np.column_stack([np.ones(z.size), z]),
        lambda a, w, z, i, o: f"{_number(a[0], o)} + {_number(a[1], _per(o, i, 1))} {z}",
    ),
    _Term(
        "linear and cube",
        False,
        lambda z, w: np.column_stack([z, z**3]),
        lambda a, w, z, i, o: f"{_number(a[0], _per(o, i, 1))} {z} + {_number(a[1], _per(o, i, 3))} {z}^3",
    ),
    _Term(
        "constant and sign",
        False,
        lambda z, w: np.column_stack([np.ones(z.size), np.sign(z)]),
        lambda a, w, z, i, o: f"{_number(a[0], o)} + {_number(a[1], o)} sign({z})",
    ),
)
