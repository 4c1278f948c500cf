"""Whether the values a model begins with lie within the bounds that it declares."""

from collections.abc import Sequence

from fmu_build.errors import BuildError
from fmu_build.lower.ode_model import Variable
from fmu_build.lower.table import Entry

_ROUNDING = 1e-12  # of the bound: a value computed to lie on it


def check_bounds(class_name: str, rows: Sequence[Variable], entries: Sequence[Entry]) -> None:
    """Check min <= start <= max of every variable where these are numbers; `entries` tell where each is declared.

    An importer may refuse an FMU whose own start values lie outside its bounds, and a fit could not begin there.

    Raises:
        BuildError: the first variable that breaks it, at its declaration.
    """
    for row, entry in zip(rows, entries, strict=True):
        objection = _objection(row)
        if objection:
            span = entry.variable.flat.span
            raise BuildError(f"{row.name} of {class_name}: {objection}", span.file, span.line)


def _objection(row: Variable) -> str:
    low, high, start = row.min, row.max, row.start
    unit = f" {row.unit}" if row.unit and row.unit != "1" else ""
    if low is not None and high is not None and low > high:
        return f"min = {low:g}{unit} is larger than max = {high:g}{unit}; correct one of them"
    if start is None:
        return ""
    if low is not None and start < low - _ROUNDING * abs(low):
        return f"its value {start:g}{unit} is below min = {low:g}{unit}; correct the value or the bound"
    if high is not None and start > high + _ROUNDING * abs(high):
        return f"its value {start:g}{unit} is above max = {high:g}{unit}; correct the value or the bound"
    return ""
