"""The variable table as the FMU shows it: time first, then the model's variables, then the event indicators."""

from dataclasses import replace

import casadi as ca

from fmu_build.lower.ode_model import OdeModel, ScalarType, Variable

TIME = Variable(
    name="time",
    scalar_type=ScalarType.REAL,
    causality="independent",
    variability="continuous",
    initial=None,
    vector="t",
    index=0,
    unit="s",
    description="Simulation time",
)


def complete_table(model: OdeModel) -> OdeModel:
    """`model` with a table whose row number is the value reference, in C and in both descriptions.

    FMI 3 describes an event indicator by a variable, so each becomes a row, kept in w.
    """
    rows = [variable for variable in model.variables if variable.vector != "t"]
    indicators = [r.value for r in model.relations if r.instant is None]
    first = model.outputs.numel()
    shown = [_indicator(k + 1, first + k) for k in range(len(indicators))]
    return replace(model, variables=(TIME, *rows, *shown), outputs=ca.vertcat(model.outputs, *indicators))


def indicator_rows(model: OdeModel) -> list[int]:
    """Rows of the event indicators in a completed table, in the order of the relations that are not of time."""
    count = sum(r.instant is None for r in model.relations)
    return list(range(len(model.variables) - count, len(model.variables)))


def derivative_rows(model: OdeModel) -> list[tuple[int, int]]:
    """Per continuous state, in the order of x: (row of the state, row of its derivative)."""
    row_of = {variable.name: row for row, variable in enumerate(model.variables)}
    pairs: dict[int, tuple[int, int]] = {}
    for row, variable in enumerate(model.variables):
        if variable.derivative_of is not None:
            state = row_of[variable.derivative_of]
            pairs.setdefault(model.variables[state].index, (state, row))
    return [pairs[k] for k in range(model.symbols.x.numel())]


def _indicator(number: int, index: int) -> Variable:
    return Variable(
        name=f"'event indicator'[{number}]",
        scalar_type=ScalarType.REAL,
        causality="local",
        variability="continuous",
        initial="calculated",
        vector="w",
        index=index,
        description="Changes its sign at a state event",
    )
