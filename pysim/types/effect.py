"""A physical effect that a model may lack: which slot it fills, and what of it can be set."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from pysim.types.errors import BadInput
from pysim.types.experiment import Experiment


@dataclass(frozen=True)
class EffectParameter:
    """One parameter of an effect, numbers in `unit`.

    Args:
        name: as the class declares it.
        unit: SI.
        min, max: bounds.
        nominal: a usual size.
        default: as declared.
        off: the value at which the effect vanishes; None for one that only shapes it.
        description: in words.
        inverse: name of the quantity of which this is one over, as people speak of it; "" where it is itself.
        limits: name of the class' variable whose size that quantity limits, so that it acts from there on; "" for none.
    Raises:
        BadInput: bounds the wrong way round, or a default outside of them.
    """

    name: str
    unit: str
    min: float
    max: float
    nominal: float
    default: float
    off: float | None
    description: str = ""
    inverse: str = ""
    limits: str = ""

    def __post_init__(self) -> None:
        if not self.min < self.max:
            raise BadInput(f"parameter {self.name}: min is {self.min:g} and max {self.max:g}; put the smaller first")
        if not self.min <= self.default <= self.max:
            raise BadInput(
                f"parameter {self.name}: {self.default:g} is outside {self.min:g} ... {self.max:g}; move one"
            )

    def reported(self, value: float) -> tuple[str, float]:
        """Name and value as people speak of it; one over zero is infinite."""
        if not self.inverse:
            return self.name, value
        return self.inverse, 1 / value if value else math.inf


@dataclass(frozen=True)
class Effect:
    """One effect of a catalogue.

    Args:
        name: its standard name, such as "friction.coulomb".
        slot: the replaceable part of the model that it fills.
        class_name: full name of its Modelica class.
        parameters: strengths and shapes, in the class' order.
        description: in words.
        bypass: whether off is a limit that its equations do not reach; the slot's own filling stands for it then.
        law: its equations, as the class writes them.
        smooth: the same effect, written without events, which a search takes in its place; None where it has none.
    Raises:
        BadInput: no strength, a `smooth` with other parameters or another slot, or two parameters of one name.
    """

    name: str
    slot: str
    class_name: str
    parameters: tuple[EffectParameter, ...]
    description: str = ""
    bypass: bool = False
    law: str = ""
    smooth: Effect | None = None

    def __post_init__(self) -> None:
        names = [parameter.name for parameter in self.parameters]
        if len(set(names)) < len(names):
            raise BadInput(f"effect {self.name}: two parameters have one name among {', '.join(names)}; rename one")
        if not self.strengths:
            raise BadInput(
                f"effect {self.name}: no parameter is 0 as declared; declare its strength in it with = 0 for off"
            )

        if self.smooth is not None and (self.smooth.slot != self.slot or not _same(self, self.smooth)):
            raise BadInput(
                f"effect {self.name}: {self.smooth.class_name} stands in for it with another slot or other parameters; "
                "give it the same"
            )

    @property
    def strengths(self) -> tuple[EffectParameter, ...]:
        """The parameters that make it vanish when all are at their off value."""
        return tuple(parameter for parameter in self.parameters if parameter.off is not None)

    @property
    def limit(self) -> EffectParameter | None:
        """The strength that is one over the size of a limit; None where the effect limits nothing."""
        return next((parameter for parameter in self.strengths if parameter.inverse), None)

    def is_special_case_of(self, other: Effect) -> bool:
        """Whether the other fills the same slot and declares all its parameters, by name and range, and more."""
        own, its = ({replace(p, description="") for p in one.parameters} for one in (self, other))
        return self.slot == other.slot and own < its

    def __getitem__(self, name: str) -> EffectParameter:
        """The parameter of that name, or the one that people call so."""
        for parameter in self.parameters:
            if name in (parameter.name, parameter.inverse):
                return parameter
        raise BadInput(f"{self.name} has no parameter {name!r}; it has {', '.join(p.name for p in self.parameters)}")

    def on(self, experiment: Experiment, *, place: str = "", **values: float) -> Experiment:
        """The experiment with the effect's parameters set.

        Args:
            place: where in the model it is; its slot by default.
            values: by name, in the parameter's unit; a name people use, such as u_max, is turned over, infinity to off.
        Raises:
            BadInput: an unknown name, or a value outside its bounds, as zero of one that is turned over.
        """
        settings = {}
        for name, value in values.items():
            parameter = self[name]
            turned = name == parameter.inverse
            if turned and value == 0:
                raise BadInput(f"{self.name}: {name} = 0 has no inverse; give another value, or inf for no effect")
            number = 1 / value if turned else value
            if not parameter.min <= number <= parameter.max:
                raise BadInput(
                    f"{self.name}: {name} = {value:g} is outside its bounds; "
                    f"{parameter.name} may be {parameter.min:g} to {parameter.max:g} {parameter.unit}"
                )
            settings[f"{place or self.slot}.{parameter.name}"] = number
        return experiment.override(**settings)


def _same(*effects: Effect) -> bool:
    """Whether they have the same parameters, but for their descriptions."""
    one, other = ([replace(p, description="") for p in effect.parameters] for effect in effects)
    return one == other
