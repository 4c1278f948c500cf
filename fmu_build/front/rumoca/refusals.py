"""The one list of what rumoca would drop, mix up or miscount without a word, and the version it is for.

Whoever takes another version of rumoca looks at each: what that version does right can go, with its tests.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from fmu_build.errors import BuildError
from fmu_build.front.flat_model import FlatModel
from fmu_build.front.rumoca.form.places import Places
from fmu_build.front.rumoca.refused.actions import refuse_lost_actions
from fmu_build.front.rumoca.refused.conditions import refuse_folded_conditions
from fmu_build.front.rumoca.refused.constants import refuse_mixed_constants
from fmu_build.front.rumoca.refused.elements import refuse_mixed_indices
from fmu_build.front.rumoca.refused.enormous import refuse_enormous_models, refuse_enormous_texts
from fmu_build.front.rumoca.refused.miscounted import miscounted
from fmu_build.front.rumoca.refused.overrides import refuse_unknown_overrides
from fmu_build.front.rumoca.refused.redeclarations import refuse_lost_redeclarations
from fmu_build.text.classes import ClassText
from fmu_build.text.lookup import Libraries

Check = TypeVar("Check", bound=Callable[..., object])


@dataclass(frozen=True)
class Refusal(Generic[Check]):
    """One thing that rumoca does wrong.

    Args:
        wrong: what it does.
        version: of rumoca in which it was seen.
        check: raises a BuildError or TextError where a model would suffer from it.
    """

    wrong: str
    version: str
    check: Check


# Ahead of rumoca, from the text: the class, and the libraries.
TEXT: tuple[Refusal[Callable[[ClassText, Libraries], None]], ...] = (
    Refusal("loses redeclarations, and modifications in them", "0.10.2", refuse_lost_redeclarations),
    Refusal("gives constants of a package the values of another", "0.10.2", refuse_mixed_constants),
    Refusal(
        "mixes up the dimensions of arrays of parts, and of those with several iterators",
        "0.10.2",
        refuse_mixed_indices,
    ),
    Refusal("writes out arrays, ranges and chains of any length", "0.10.2", refuse_enormous_texts),
)
# After it, from its own form of the model.
FORM: tuple[Refusal[Callable[[Mapping[str, Any], Places], None]], ...] = (
    Refusal("decides an if in a when-clause by the parameters' default values", "0.10.2", refuse_folded_conditions),
)
# After it, from the flat model: the class, the libraries, the model, and the values set.
MODEL: tuple[Refusal[Callable[[ClassText, Libraries, FlatModel, Mapping[str, float | str]], None]], ...] = (
    Refusal("takes a value for a parameter that does not exist", "0.10.2", refuse_unknown_overrides),
    Refusal("hands over variables and loops of any size", "0.10.2", refuse_enormous_models),
    Refusal("drops assertions and when-clauses of an if-equation", "0.10.2", refuse_lost_actions),
)
# Where it fails: what it says, the class, and the libraries -> the error at what it has miscounted, if it has.
FAILED: tuple[Refusal[Callable[[str, ClassText, Libraries], BuildError | None]], ...] = (
    Refusal("miscounts outer variables, and arrays behind each", "0.10.2", miscounted),
)
