"""The functions of model.h as expressions: which results each has, in which order, and their derivatives."""

from dataclasses import dataclass, fields

import casadi as ca

from fmu_build.lower.ode_model import OdeModel, Symbols
from fmu_build.lower.values import column


@dataclass(frozen=True)
class ModelFunction:
    """A member of `struct Model`: its name there and its results in order, each of any shape."""

    name: str
    results: tuple[ca.SX, ...]

    @property
    def is_empty(self) -> bool:
        return all(result.numel() == 0 for result in self.results)


@dataclass(frozen=True)
class _Seeds:
    """Tangents of the arguments and weights of the results, in the order of `enum Argument`."""

    x: ca.SX
    u: ca.SX
    p: ca.SX
    v: ca.SX
    q: ca.SX
    weight_dx: ca.SX
    weight_w: ca.SX
    weight_g: ca.SX


def _symbols_of(instance: Symbols | _Seeds) -> list[ca.SX]:
    return [getattr(instance, field.name) for field in fields(instance)]


def model_functions(model: OdeModel) -> tuple[list[ca.SX], tuple[ModelFunction, ...]]:
    """The arguments that all functions share (one per entry of `enum Argument`) and the functions."""
    s = model.symbols
    seeds = _Seeds(
        **{name: ca.SX.sym(f"seed_{name}", getattr(s, name).numel()) for name in ("x", "u", "p", "v", "q")},
        weight_dx=ca.SX.sym("weight_dx", model.derivatives.numel()),
        weight_w=ca.SX.sym("weight_w", model.outputs.numel()),
        weight_g=ca.SX.sym("weight_g", model.residual.numel()),
    )
    functions = (
        ModelFunction("calculated", (model.calculated,)),
        ModelFunction(
            "initial_residual",
            (model.initial_residual, ca.jacobian(model.initial_residual, s.i), model.guess_i),
        ),
        ModelFunction("start", (model.start_x, model.start_d, model.start_q)),
        ModelFunction("derivatives", (model.derivatives,)),
        ModelFunction("outputs", (model.outputs,)),
        ModelFunction("residual", (model.residual, ca.jacobian(model.residual, s.q))),
        ModelFunction("indicators", (column([relation.value for relation in model.relations]),)),
        _instants(model),
        ModelFunction(
            "delays",
            (
                column([delay.source for delay in model.delays]),
                column([delay.time for delay in model.delays]),
                column([delay.maximum for delay in model.delays]),
            ),
        ),
        ModelFunction(
            "update",
            (
                model.updates_d,
                model.updates_b,
                model.updates_x,
                column([check.condition for check in model.terminations]),
            ),
        ),
        ModelFunction("check", (column([check.condition for check in model.checks]),)),
        _jacobian(model),
        _forward(model, seeds),
        _reverse(model, seeds),
    )
    return [*_symbols_of(s), *_symbols_of(seeds)], functions


def _instants(model: OdeModel) -> ModelFunction:
    changes = [ca.SX(0) if relation.instant is None else relation.instant for relation in model.relations]
    return ModelFunction(
        "instants",
        (
            column(changes),
            column([sample.start for sample in model.samples]),
            column([sample.interval for sample in model.samples]),
        ),
    )


def _jacobian(model: OdeModel) -> ModelFunction:
    s = model.symbols
    return ModelFunction(
        "jacobian",
        (
            ca.jacobian(model.derivatives, s.x),
            ca.jacobian(model.derivatives, s.q),
            ca.jacobian(model.residual, s.x),
            ca.jacobian(model.derivatives, s.t),
            ca.jacobian(model.residual, s.t),
            _by_parameters(model),
        ),
    )


def _by_parameters(model: OdeModel) -> ca.SX:
    """All tangents by parameters at once, a tenth of the time of `forward` for each; none where blocks would follow."""
    s = model.symbols
    if s.q.numel():
        return ca.SX(0, 0)
    through_c = ca.jacobian(model.derivatives, s.c) @ ca.jacobian(model.calculated, s.p)
    return ca.jacobian(model.derivatives, s.p) + through_c


def _forward(model: OdeModel, seeds: _Seeds) -> ModelFunction:
    """Tangents, by the chain rule through c = calculated(p)."""
    s = model.symbols
    seed_c = ca.jtimes(model.calculated, s.p, seeds.p)
    arguments = ca.vertcat(s.x, s.u, s.p, s.v, s.q, s.c)
    tangent = ca.vertcat(seeds.x, seeds.u, seeds.p, seeds.v, seeds.q, seed_c)
    results = (model.derivatives, model.outputs, model.residual)
    return ModelFunction("forward", tuple(_times(result, arguments, tangent) for result in results))


def _times(result: ca.SX, arguments: ca.SX, tangent: ca.SX) -> ca.SX:
    return ca.jtimes(result, arguments, tangent) if result.numel() else ca.SX(0, 1)


def _reverse(model: OdeModel, seeds: _Seeds) -> ModelFunction:
    """Weights of the arguments; the weight of c is handed on to p."""
    s = model.symbols
    results = ca.vertcat(model.derivatives, model.outputs, model.residual)
    weights = ca.vertcat(seeds.weight_dx, seeds.weight_w, seeds.weight_g)
    arguments = ca.vertcat(s.x, s.u, s.p, s.q, s.v, s.c)
    gradient = ca.jtimes(results, arguments, weights, True)
    sizes = [part.numel() for part in (s.x, s.u, s.p, s.q, s.v, s.c)]
    x, u, p, q, v, c = ca.vertsplit(gradient, [sum(sizes[:k]) for k in range(len(sizes) + 1)])
    p = p + ca.jtimes(model.calculated, s.p, c, True)
    return ModelFunction("reverse", (x, u, p, q, v))
