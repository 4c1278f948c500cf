"""Modelica's built-in functions and operators on symbolic values."""

from collections.abc import Callable, Sequence
from functools import reduce

import casadi as ca
import numpy as np

from fmu_build.lower.values import Scalar, Value, array, broadcast, fixed_number, scalars

# Of scalars, elementwise. abs, sign, min and max cause no event: they follow their arguments at once.
ELEMENTWISE: dict[str, Callable[..., Scalar]] = {
    "abs": lambda x: ca.if_else(x >= 0, x, -x),  # slope 1 at 0, as beside a branch "if x >= 0"; that of fabs is 0
    "sign": ca.sign,
    "sqrt": ca.sqrt,
    "exp": ca.exp,
    "log": ca.log,
    "log10": ca.log10,
    "sin": ca.sin,
    "cos": ca.cos,
    "tan": ca.tan,
    "asin": ca.asin,
    "acos": ca.acos,
    "atan": ca.atan,
    "atan2": ca.atan2,
    "sinh": ca.sinh,
    "cosh": ca.cosh,
    "tanh": ca.tanh,
    "floor": ca.floor,
    "ceil": ca.ceil,
    "integer": ca.floor,
    "mod": lambda x, y: x - ca.floor(x / y) * y,
    "rem": lambda x, y: x - _truncate(x / y) * y,
    "div": lambda x, y: _truncate(x / y),
    "homotopy": lambda actual, simplified: actual,
    "semi_linear": lambda x, positive, negative: ca.if_else(x >= 0, positive * x, negative * x),
}

# Their values jump: outside of noEvent() they need events.
JUMPING = ("floor", "ceil", "integer", "mod", "rem", "div")


def _truncate(x: Scalar) -> Scalar:
    return ca.if_else(x >= 0, ca.floor(x), ca.ceil(x))


def _size(value: Value) -> int:
    """An array dimension, which has to be a number."""
    return round(fixed_number(value))


def _fill(value: Value, *sizes: Value) -> np.ndarray:
    shape = tuple(_size(n) for n in sizes)
    return array([value] * int(np.prod(shape))).reshape(shape)


def _identity(size: Value) -> np.ndarray:
    n = _size(size)
    return array(ca.SX(int(row == column)) for row in range(n) for column in range(n)).reshape(n, n)


def _diagonal(vector: np.ndarray) -> np.ndarray:
    n = len(vector)
    return array(vector[r] if r == c else ca.SX(0) for r in range(n) for c in range(n)).reshape(n, n)


def _linspace(first: Scalar, last: Scalar, count: Value) -> np.ndarray:
    n = _size(count)
    return array(first + (last - first) * k / (n - 1) for k in range(n))


def _extreme(choose: Callable[[Scalar, Scalar], Scalar]) -> Callable[..., Value]:
    def extreme(*values: Value) -> Value:
        return broadcast(choose, *values) if len(values) == 2 else reduce(choose, scalars(values[0]))

    return extreme


def _promoted(dimension: int) -> Callable[..., np.ndarray]:
    """`[a, b; c, d]`: every part is a matrix, joined along `dimension`."""

    def join(*parts: Value) -> np.ndarray:
        matrices = []
        for part in parts:
            whole = part if isinstance(part, np.ndarray) else array([part])
            matrices.append(whole.reshape(whole.shape + (1,) * (2 - whole.ndim)) if whole.ndim < 2 else whole)
        return np.concatenate(matrices, axis=dimension)

    return join


def _cat(dimension: Value, *parts: Value) -> np.ndarray:
    return np.concatenate(parts, axis=_size(dimension) - 1)


def _cross(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    return array(x[(k + 1) % 3] * y[(k + 2) % 3] - x[(k + 2) % 3] * y[(k + 1) % 3] for k in range(3))


def _total(values: Sequence[Scalar]) -> Scalar:
    return reduce(lambda a, b: a + b, values, ca.SX(0))


WHOLE: dict[str, Callable[..., Value]] = {
    "min": _extreme(ca.fmin),
    "max": _extreme(ca.fmax),
    "sum": lambda value: _total(scalars(value)),
    "product": lambda value: reduce(lambda a, b: a * b, scalars(value), ca.SX(1)),
    "transpose": lambda matrix: matrix.T,
    "zeros": lambda *sizes: _fill(ca.SX(0), *sizes),
    "ones": lambda *sizes: _fill(ca.SX(1), *sizes),
    "fill": _fill,
    "identity": _identity,
    "diagonal": _diagonal,
    "linspace": _linspace,
    "scalar": lambda value: scalars(value)[0],
    "vector": lambda value: array(scalars(value)),
    "cross": _cross,
    "cat": _cat,
    "promoted_cat1": _promoted(0),
    "promoted_cat2": _promoted(1),
    "outer_product": lambda x, y: array(a * b for a in x for b in y).reshape(len(x), len(y)),
}


def multiply(left: Value, right: Value) -> Value:
    """Modelica's `*`: elementwise with a scalar, else the matrix product."""
    if isinstance(left, np.ndarray) and isinstance(right, np.ndarray):
        return np.dot(left, right)
    return broadcast(lambda a, b: a * b, left, right)


def power(base: Value, exponent: Scalar) -> Value:
    """Modelica's `^`: of a matrix, which the front end has found square, it is the repeated matrix product."""
    if not isinstance(base, np.ndarray):
        return ca.power(base, exponent)
    if not exponent.is_constant() or float(exponent) < 0:
        raise ValueError(
            "a matrix has a power by a whole number from 0 on only, fixed when the FMU is built; write a literal, or "
            "make the parameter final"
        )
    return reduce(np.dot, [base] * round(float(exponent)), _identity(ca.SX(len(base))))


ARITHMETIC: dict[str, Callable[[Value, Value], Value]] = {
    "add": lambda x, y: broadcast(lambda a, b: a + b, x, y),
    "subtract": lambda x, y: broadcast(lambda a, b: a - b, x, y),
    "multiply": multiply,
    "divide": lambda x, y: broadcast(lambda a, b: a / b, x, y),
    "power": power,
    "and": lambda x, y: broadcast(ca.logic_and, x, y),
    "or": lambda x, y: broadcast(ca.logic_or, x, y),
}
for _name in ("add", "subtract", "divide"):
    ARITHMETIC[f"elementwise_{_name}"] = ARITHMETIC[_name]
ARITHMETIC["elementwise_power"] = lambda x, y: broadcast(ca.power, x, y)
ARITHMETIC["elementwise_multiply"] = lambda x, y: broadcast(lambda a, b: a * b, x, y)
