"""The one adapter to rumoca 0.10.2: a class -> FlatModel. Nothing outside of it knows rumoca's forms and errors."""

from collections.abc import Mapping

from fmu_build.front.expression import Span
from fmu_build.front.flat_model import Experiment, FlatModel
from fmu_build.text.classes import ClassText
from fmu_build.text.lookup import Libraries

__all__ = ["compiled"]


def compiled(
    source: ClassText,
    classes: Libraries,
    overrides: Mapping[str, float | str],
    *,
    experiment: Experiment,
    documentation: str,
) -> FlatModel:
    """Compile a class with values set, and refuse what rumoca would get wrong.

    Args:
        experiment, documentation: of the class; rumoca does not pass on its annotations.
    Raises:
        BuildError, TextError: the class cannot be compiled, or not rightly.
    """
    from fmu_build.front.rumoca.copied import with_followed_records
    from fmu_build.front.rumoca.evaluated import with_evaluated
    from fmu_build.front.rumoca.form import to_flat_model
    from fmu_build.front.rumoca.refusals import FORM, MODEL, TEXT
    from fmu_build.front.rumoca.session import compile_class

    for ahead in TEXT:
        ahead.check(source, classes)
    dae, flat = compile_class(source, classes.places, overrides)
    model = to_flat_model(
        dae,
        flat,
        name=source.full_name,
        span=Span(*source.place(source.start)),
        experiment=experiment,
        documentation=documentation,
        description=source.description,
        checks=[refusal.check for refusal in FORM],
    )
    for behind in MODEL:
        behind.check(source, classes, model, overrides)
    model = with_followed_records(model, flat, source, classes)
    return with_evaluated(model, dae, flat, source, classes)
