"""The variable table of an `OdeModel`: names, kinds and places; attributes become numbers."""

from collections.abc import Sequence
from dataclasses import dataclass

import casadi as ca

from fmu_build.front.flat_model import Scalar as ScalarKind
from fmu_build.lower.evaluate import Evaluator
from fmu_build.lower.ode_model import Causality, Initial, ScalarType, Variability, Variable, Vector
from fmu_build.lower.scope import ScalarVariable
from fmu_build.lower.start import attribute
from fmu_build.lower.values import Scalar, column

TYPES = {
    ScalarKind.REAL: ScalarType.REAL,
    ScalarKind.INTEGER: ScalarType.INTEGER,
    ScalarKind.ENUMERATION: ScalarType.INTEGER,
    ScalarKind.BOOLEAN: ScalarType.BOOLEAN,
}


class Numbers:
    """Values of expressions in parameters at the parameters' default values."""

    def __init__(self, symbols: Sequence[Scalar], values: Sequence[float | None]) -> None:
        known = [(symbol, value) for symbol, value in zip(symbols, values, strict=True) if value is not None]
        self._symbols = column(symbol for symbol, _ in known)
        self._values = [value for _, value in known]
        self._known = {symbol.element_hash() for symbol, _ in known}

    def of(self, expressions: Sequence[Scalar | None]) -> list[float | None]:
        """Numbers; None for None and for what depends on more than parameters."""
        usable = [k for k, e in enumerate(expressions) if e is not None and self._is_known(e)]
        results: list[float | None] = [None] * len(expressions)
        if usable:
            function = ca.Function("numbers", [self._symbols], [column(expressions[k] for k in usable)])
            for k, number in zip(usable, function(self._values).full().ravel().tolist(), strict=True):
                results[k] = float(number)
        return results

    def _is_known(self, expression: Scalar) -> bool:
        return all(symbol.element_hash() in self._known for symbol in ca.symvar(expression))


@dataclass(frozen=True)
class Entry:
    """Where a variable is kept and how it begins; the rest of its row comes from the model."""

    variable: ScalarVariable
    causality: Causality
    variability: Variability
    initial: Initial | None
    vector: Vector
    index: int
    start: Scalar | None = None
    derivative_of: str | None = None


def make_rows(entries: Sequence[Entry], evaluator: Evaluator, numbers: Numbers) -> tuple[Variable, ...]:
    """The table's rows, in the order of `entries`."""
    attributes = [_attribute(entry, name, evaluator) for name in ("min", "max", "nominal") for entry in entries]
    values = numbers.of([*attributes, *(entry.start for entry in entries)])
    n = len(entries)
    return tuple(_row(entry, *(values[k + part * n] for part in range(4))) for k, entry in enumerate(entries))


def _attribute(entry: Entry, name: str, evaluator: Evaluator) -> Scalar | None:
    return None if entry.derivative_of is not None else attribute(entry.variable, name, evaluator)


def _row(entry: Entry, low: float | None, high: float | None, nominal: float | None, start: float | None) -> Variable:
    flat, is_derivative = entry.variable.flat, entry.derivative_of is not None
    return Variable(
        name=f"der({entry.variable.name})" if is_derivative else entry.variable.name,
        scalar_type=TYPES[flat.scalar],
        causality=entry.causality,
        variability=entry.variability,
        initial=entry.initial,
        vector=entry.vector,
        index=entry.index,
        start=start,
        unit=derivative_unit(flat.unit) if is_derivative else flat.unit,
        display_unit=None if is_derivative else flat.display_unit,
        quantity=None if is_derivative else flat.quantity,
        description=None if is_derivative else flat.description,
        min=low,
        max=high,
        nominal=nominal,
        derivative_of=entry.derivative_of,
        enumeration=flat.enumeration,
    )


def derivative_unit(unit: str | None) -> str | None:
    """Unit of the time derivative in Modelica's unit syntax."""
    if unit is None:
        return None
    if unit in ("1", ""):
        return "1/s"
    numerator, _, denominator = unit.partition("/")
    if not denominator:
        return f"{unit}/s"
    if "/" in denominator or unit.startswith("("):
        return f"({unit})/s"
    inner = denominator.removeprefix("(").removesuffix(")")
    factors = _times_second(inner)
    return f"{numerator}/({factors})" if "." in factors else f"{numerator}/{factors}"


def _times_second(denominator: str) -> str:
    factors = denominator.split(".")
    for k, factor in enumerate(factors):
        if factor == "s" or (factor.startswith("s") and factor[1:].isdigit()):
            factors[k] = f"s{int(factor[1:] or 1) + 1}"
            return ".".join(factors)
    return ".".join([*factors, "s"])
