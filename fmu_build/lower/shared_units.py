"""The unit of a variable that declares none, from the sums it stands in: `y = s` and `e = r - y` have one unit each."""

from collections.abc import Iterator

from fmu_build.front import expression as ex
from fmu_build.front.flat_model import FlatModel


def unit_of(name: str, flat: FlatModel) -> str | None:
    """The declared unit of the variable, or of those it is added to, subtracted from or set equal to.

    Returns:
        None where no unit is declared along such equations, or where two differ.
    """
    declared = {variable.name: variable.unit for variable in flat.variables}
    if declared.get(name) is not None:
        return declared[name]
    neighbours: dict[str, set[str]] = {}
    for equation in flat.equations:
        together = set(_summands(equation.residual))
        for one in together:
            neighbours.setdefault(one, set()).update(together - {one})
    reached, edge, units = {name}, [name], set()
    while edge:
        current = edge.pop()
        unit = declared.get(current)
        if unit is not None:
            units.add(unit)
            continue
        new = neighbours.get(current, set()) - reached
        reached |= new
        edge += new
    return units.pop() if len(units) == 1 else None


def _summands(node: ex.Expression) -> Iterator[str]:
    """Names of the variables that stand in a sum by themselves."""
    match node:
        case ex.Reference(name=name, form=ex.Form.VALUE):
            yield name
        case ex.Unary(operator="negate" | "plus", operand=inner):
            yield from _summands(inner)
        case ex.Binary(
            operator="add" | "subtract" | "elementwise_add" | "elementwise_subtract", left=left, right=right
        ):
            yield from _summands(left)
            yield from _summands(right)
