"""rumoca's conditions and triggers -> when-clauses in their elsewhen order."""

from collections.abc import Mapping
from typing import Any

from fmu_build.errors import BuildError
from fmu_build.front import expression as ex
from fmu_build.front.flat_model import Activation, WhenClause
from fmu_build.front.rumoca.form.expressions import Arena
from fmu_build.front.rumoca.form.flat_form import FlatForm
from fmu_build.front.rumoca.form.places import Places


class Clauses:
    """Turns condition numbers into expressions and when-clauses; collects the clauses that are used."""

    def __init__(self, storage: Mapping[str, Any], flat: FlatForm, places: Places) -> None:
        self._storage = storage
        self._flat = flat
        self._places = places
        self.arena = Arena(storage, places, self.condition)
        self._samples = {
            number: flat.next_sample(condition["provenance"])
            for number, condition in enumerate(storage["conditions"])
            if isinstance(condition["node"], Mapping) and "clock" in condition["node"]
        }
        self._clause_of_trigger: dict[int, int] = {}
        self._previous = self._elsewhen_order()
        self.clauses: list[WhenClause] = []

    def condition(self, number: int) -> ex.Expression:
        """A condition as a Boolean expression."""
        return self._boolean(number, None)

    def activation(self, trigger: int, guard: int) -> Activation:
        if guard == trigger:
            return Activation(self.clause(trigger))
        return Activation(self.clause(trigger), self._boolean(guard, trigger))

    def clause(self, trigger: int) -> int:
        """Number of the when-clause of a trigger."""
        if trigger not in self._clause_of_trigger:
            previous = self._previous.get(trigger)
            before = None if previous is None else self.clause(previous)
            span = self._places.span(self._storage["conditions"][trigger]["provenance"])
            conditions = tuple(self._boolean(number, None) for number in self._parts(trigger))
            self._clause_of_trigger[trigger] = len(self.clauses)
            self.clauses.append(WhenClause(conditions, before, span))
        return self._clause_of_trigger[trigger]

    def is_always(self, trigger: int) -> bool:
        return bool(self._storage["conditions"][trigger]["node"] == "always")

    def violation(self, trigger: int, guard: int) -> ex.Expression:
        """The guard of an action, the trigger taken as given."""
        return self._boolean(guard, trigger)

    def _parts(self, number: int) -> list[int]:
        node = self._storage["conditions"][number]["node"]
        if isinstance(node, Mapping) and "any_rise" in node:
            return self._parts(node["any_rise"]["lhs"]) + self._parts(node["any_rise"]["rhs"])
        return [number]

    def _boolean(self, number: int, given: int | None) -> ex.Expression:
        """Condition `number`; the condition `given` holds wherever it occurs."""
        condition = self._storage["conditions"][number]
        node, span = condition["node"], self._places.span(condition["provenance"])
        if number == given or node == "always":
            return ex.Literal(span, True)
        if node == "initial":
            return ex.Initial(span)
        ((kind, what),) = node.items()
        if kind == "relation":
            return self.arena.expression(self._storage["relations"][what]["relation"]["expression"])
        if kind == "discrete":
            return self.arena.expression(what)
        if kind == "clock":
            return self._samples[number]
        if kind == "not":
            return ex.Unary(span, "not", self._boolean(what, given))
        if kind in ("and", "or"):
            return ex.Binary(span, kind, self._boolean(what["lhs"], given), self._boolean(what["rhs"], given))
        raise BuildError(f"condition of kind '{kind}' is not supported here", span.file, span.line)

    def _elsewhen_order(self) -> dict[int, int]:
        """For the trigger of each elsewhen branch, the trigger of the branch before it.

        rumoca's DAE form drops the order; it is found again by what each branch of the flat form sets.
        """
        triggers: dict[int, int] = {}  # branch -> trigger
        for (kind, name), used in self._triggers_by_target().items():
            branches = [
                number
                for number, branch in enumerate(self._flat.branches)
                if name in (branch.states if kind == "state" else branch.targets)
            ]
            if len(branches) != len(used):
                if any(self._flat.branches[number].previous is not None for number in branches):
                    raise self._lost(used[0])
                continue
            for branch, trigger in zip(branches, used, strict=True):
                triggers[branch] = trigger
        order = {}
        for branch, trigger in triggers.items():
            previous = self._flat.branches[branch].previous
            if previous is not None:
                if previous not in triggers:
                    raise self._lost(trigger)
                order[trigger] = triggers[previous]
        return order

    def _lost(self, trigger: int) -> BuildError:
        span = self._places.span(self._storage["conditions"][trigger]["provenance"])
        return BuildError(
            "every branch before an elsewhen must set a variable or a state of its own", span.file, span.line
        )

    def _triggers_by_target(self) -> dict[tuple[str, str], list[int]]:
        used: dict[tuple[str, str], list[int]] = {}

        def note(kind: str, name: str, activation: Any) -> None:
            triggers = used.setdefault((kind, name), [])
            if activation["trigger"] not in triggers:
                triggers.append(activation["trigger"])

        names = [variable["name"] for variable in self._storage["variables"]]
        for equation in self._storage["discrete_real_equations"]:
            if isinstance(equation["activation"], Mapping):
                note("value", self.real_target(equation)[0], equation["activation"]["when"])
        for owner in self._storage["discrete_value_owners"]:
            for branch in owner["branches"]:
                for target in owner["targets"]:
                    if isinstance(branch["activation"], Mapping):
                        note("value", names[target], branch["activation"]["when"])
        for action in self._storage["event_actions"]:
            if "reinitialize" in action["kind"]:
                note("state", names[action["kind"]["reinitialize"]["state"]], action)
        return used

    def real_target(self, equation: Mapping[str, Any]) -> tuple[str, ex.Expression]:
        """Target and value of a discrete Real equation, which rumoca writes as `target - value`."""
        residual = self.arena.expression(equation["residual"])
        if isinstance(residual, ex.Binary) and isinstance(residual.left, ex.Reference):
            return residual.left.name, residual.right
        raise BuildError(
            "an equation of a discrete variable must give the whole variable: name = expression",
            residual.span.file,
            residual.span.line,
        )
