"""FlatModel -> OdeModel: the phases in order."""

from collections.abc import Sequence
from functools import partial

import casadi as ca

from fmu_build.front.flat_model import FlatModel
from fmu_build.lower.bounds import check_bounds
from fmu_build.lower.continuous import Solved, scalar_equations, solve_continuous
from fmu_build.lower.discrete import DiscretePart
from fmu_build.lower.evaluate import Evaluator
from fmu_build.lower.events import Events
from fmu_build.lower.inputs import check_inputs
from fmu_build.lower.ode_model import DefaultExperiment, Delay, OdeModel, Relation, Sample, Symbols
from fmu_build.lower.parameters import Parameters, explicit
from fmu_build.lower.places import place_variables
from fmu_build.lower.probes import add_probes, with_probe_inputs
from fmu_build.lower.scope import Scope
from fmu_build.lower.start import attribute, initial_conditions, start_values
from fmu_build.lower.table import Numbers, make_rows
from fmu_build.lower.values import Scalar, column


def lower(flat: FlatModel, probes: Sequence[str] = ()) -> OdeModel:
    """Sort and solve a flat model into explicit ODEs with events.

    Args:
        probes: variables whose equation gets a further input (`probes.py`).
    Raises:
        BuildError: unbalanced or singular equations, a construct outside the supported subset, or a probe that has no
            place.
    """
    flat = with_probe_inputs(flat, probes)
    scope = Scope(flat)
    events = Events(scope)
    evaluator = Evaluator(flat, events)
    events.parameters = parameters = Parameters(flat, evaluator)
    parameters.evaluate_all()
    equations = add_probes(flat, scope, scalar_equations(flat, evaluator), probes)
    discrete = DiscretePart(flat, scope, events, evaluator)
    typical = partial(_typical_values, scope, parameters, evaluator)
    solved = solve_continuous(flat, scope, equations, typical)
    updates = discrete.updates(solved)
    derivatives = _settled(solved.replace(scope.derivatives), scope)
    start = initial_conditions(flat, scope, parameters, evaluator, solved, typical)
    calculated = parameters.explicit(start.parameters)
    numbers = _numbers(parameters, calculated)
    shown = (*flat.variables, *events.hidden_variables)
    places = place_variables(shown, scope, parameters, calculated, solved, derivatives, start, evaluator)
    places.calculate(updates.changed_at_start(scope, events.initial))
    symbols = Symbols(
        t=scope.time,
        x=column(v.symbol for v in scope.states),
        u=column(v.symbol for v in scope.inputs),
        p=column(v.symbol for v in parameters.settable),
        c=column(c.variable.symbol for c in parameters.calculated),
        d=column(v.symbol for v in scope.discretes),
        r=column(r.symbol for r in events.relations),
        v=column(delay.symbol for delay in events.delays),
        q=column(solved.unknowns),
        i=column(start.unknowns),
        pre_d=column(scope.pre_discretes),
        pre_b=column(updates.pre_conditions),
        e=column([events.initial, events.terminal, *(sample.flag for sample in events.samples)]),
    )
    rows = make_rows(places.entries, evaluator, numbers)
    check_inputs(rows, places.entries)
    check_bounds(flat.name, rows, places.entries)
    return OdeModel(
        name=flat.name,
        description=flat.description,
        symbols=symbols,
        variables=rows,
        derivatives=column(derivatives),
        outputs=column(_settled(places.outputs, scope)),
        residual=column(_settled(solved.residuals, scope)),
        relations=_relations(events, solved, scope, parameters),
        samples=tuple(Sample(sample.start, sample.interval) for sample in events.samples),
        delays=_delays(events, solved, scope),
        updates_d=column(updates.discretes),
        updates_b=column(updates.conditions),
        updates_x=column(updates.states),
        checks=tuple(updates.checks),
        terminations=tuple(updates.terminations),
        calculated=column(calculated),
        start_x=column(start.states),
        start_d=column(start.discretes),
        start_q=column(start.iterations),
        initial_residual=column(start.residuals),
        guess_i=column(start.guesses),
        nominal_x=_nominals(scope, evaluator, numbers),
        default_experiment=DefaultExperiment(
            flat.experiment.start, flat.experiment.stop, flat.experiment.tolerance, flat.experiment.interval
        ),
        constrained=tuple(solved.constrained) if any(solved.constrained) else (),
        documentation=flat.documentation,
    )


def _settled(expressions: Sequence[Scalar], scope: Scope) -> list[Scalar]:
    """Between events pre(d) is d."""
    if not scope.discretes or not expressions:
        return list(expressions)
    now = column(v.symbol for v in scope.discretes)
    result = ca.substitute(column(expressions), column(scope.pre_discretes), now)
    return [result[k] for k in range(len(expressions))]


def _numbers(parameters: Parameters, calculated: Sequence[Scalar]) -> Numbers:
    """Default values of p and c; a parameter that the initial equations determine has none."""
    settable = [v.symbol for v in parameters.settable]
    symbols = [c.variable.symbol for c in parameters.calculated]
    return Numbers([*settable, *symbols], [*parameters.starts, *Numbers(settable, parameters.starts).of(calculated)])


def _typical_values(scope: Scope, parameters: Parameters, evaluator: Evaluator) -> dict[int, float]:
    """By the hash of its symbol what a variable starts from, or its nominal value where that is 0; parameters too."""
    calculated, _ = explicit(
        [c.variable.symbol for c in parameters.calculated], [c.value for c in parameters.calculated], []
    )
    numbers = _numbers(parameters, calculated)
    variables = [*scope.states, *scope.algebraics, *scope.inputs, *scope.discretes]
    constants = [v.symbol for v in parameters.settable] + [c.variable.symbol for c in parameters.calculated]
    starts = numbers.of(start_values(variables, evaluator))
    nominals = numbers.of([attribute(variable, "nominal", evaluator) for variable in variables])
    values = [start or nominal for start, nominal in zip(starts, nominals, strict=True)] + numbers.of(constants)
    symbols = [v.symbol for v in variables] + constants
    return {s.element_hash(): value for s, value in zip(symbols, values, strict=True) if value is not None}


def _relations(events: Events, solved: Solved, scope: Scope, parameters: Parameters) -> tuple[Relation, ...]:
    values = solved.replace([relation.value for relation in events.relations])
    slow = [
        *(v.symbol for v in (*parameters.settable, *scope.discretes)),
        *(c.variable.symbol for c in parameters.calculated),
    ]
    return tuple(
        Relation(value, relation.strict, _instant(value, scope.time, slow))
        for value, relation in zip(_settled(values, scope), events.relations, strict=True)
    )


def _instant(value: Scalar, time: Scalar, slow: Sequence[Scalar]) -> Scalar | None:
    """When a relation of time alone changes: it is linear in time and all else in it changes at events only."""
    allowed = {symbol.element_hash() for symbol in (time, *slow)}
    if any(symbol.element_hash() not in allowed for symbol in ca.symvar(value)):
        return None
    slope = ca.jacobian(value, time)
    if not slope.is_constant() or float(slope) == 0:
        return None
    return -ca.substitute(value, time, ca.SX(0)) / slope


def _delays(events: Events, solved: Solved, scope: Scope) -> tuple[Delay, ...]:
    sources = _settled(solved.replace([delay.source for delay in events.delays]), scope)
    return tuple(Delay(source, delay.time, delay.maximum) for source, delay in zip(sources, events.delays, strict=True))


def _nominals(scope: Scope, evaluator: Evaluator, numbers: Numbers) -> tuple[float, ...]:
    nominals = numbers.of([attribute(state, "nominal", evaluator) for state in scope.states])
    return tuple(1.0 if not nominal else abs(nominal) for nominal in nominals)
