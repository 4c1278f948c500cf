"""Values during symbolic execution: a CasADi scalar, or a numpy array of them (dtype object) in Modelica's order."""

from collections.abc import Callable, Iterable
from typing import Any

import casadi as ca
import numpy as np

Scalar = Any  # ca.SX of one element; CasADi carries no type hints that mypy could follow
Value = Any  # Scalar, np.ndarray of Scalar, str, or a tuple of fields for a record


def array(elements: Iterable[Any]) -> np.ndarray:
    """An array of values; arrays as elements give one more dimension."""
    items = list(elements)
    if items and isinstance(items[0], np.ndarray):
        return np.array([item.tolist() for item in items], dtype=object).reshape(len(items), *items[0].shape)
    result = np.empty(len(items), dtype=object)
    result[:] = items
    return result


def scalars(value: Value) -> list[Scalar]:
    """All scalars, row-major."""
    return list(value.ravel()) if isinstance(value, np.ndarray) else [value]


def broadcast(function: Callable[..., Scalar], *values: Value) -> Value:
    """Apply a function of scalars elementwise; scalars go with every element."""
    shapes = [value.shape for value in values if isinstance(value, np.ndarray)]
    if not shapes:
        return function(*values)
    if any(shape != shapes[0] for shape in shapes):
        raise ValueError(f"array sizes {' and '.join(str(list(shape)) for shape in shapes)} do not fit")
    columns = [scalars(value) if isinstance(value, np.ndarray) else None for value in values]
    size = int(np.prod(shapes[0]))
    rows = (
        function(*(value if column is None else column[k] for value, column in zip(values, columns, strict=True)))
        for k in range(size)
    )
    return array(rows).reshape(shapes[0])


def fixed_number(value: Scalar) -> float:
    """A number that shapes the equations, such as a size. Raises ValueError where it is not known yet."""
    if not value.is_constant():
        names = ", ".join(symbol.name() for symbol in ca.symvar(value))
        raise ValueError(
            f"an index or a size here depends on {names}, which can still change; make it final or a constant"
        )
    return float(value)


def is_true(condition: Scalar) -> bool:
    return bool(condition.is_constant() and float(condition) != 0)


def is_false(condition: Scalar) -> bool:
    return bool(condition.is_constant() and float(condition) == 0)


def choose(condition: Scalar, then: Value, otherwise: Value) -> Value:
    """`if condition then ... else ...`; what is not chosen may be infinite or undefined, its derivative too."""
    if is_true(condition):
        return then
    if is_false(condition):
        return otherwise
    if isinstance(then, tuple):
        return tuple(choose(condition, a, b) for a, b in zip(then, otherwise, strict=True))
    return broadcast(lambda a, b: a if ca.is_equal(a, b) else ca.if_else(condition, a, b), then, otherwise)


def column(elements: Iterable[Scalar]) -> ca.SX:
    """A column vector, (0 x 1) for no element."""
    items = list(elements)
    return ca.vertcat(*items) if items else ca.SX(0, 1)
