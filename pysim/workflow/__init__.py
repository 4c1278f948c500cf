"""Names and paths become objects, and objects become files again: the only place where `pysim` meets the compiler.

`open_session("Lib.Model", "measurements")` opens all that a diagnosis takes. Its parts can be had one by one:

    model = model_of("Lib.Model", [library])            an .fmu, or a class that is compiled
    data = data_of("measurements")                      a folder with a dataset.toml
    parts = session_parts(model, data, libraries=...)   catalogue, builder of variants, free parameters, notes
    session = session_of(parts)
    write_extended(diagnosis, parts, folder)            the fitted values, the extended class and its FMU

A name is imported when it is first used: whoever reads an FMU loads neither the diagnosis nor the compiler.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pysim.workflow.answer import whole_answer
    from pysim.workflow.data import BY_DATA, data_of, described_at, reference_of
    from pysim.workflow.export import export_model
    from pysim.workflow.extended import write_extended
    from pysim.workflow.fitting import Initial, beginning, fit_problem, fitted, initial_values
    from pysim.workflow.free import free_parameters, suggested
    from pysim.workflow.learned import class_name_of, keep_law, law_file, with_classes
    from pysim.workflow.model import (
        ModelInside,
        class_in,
        inside,
        is_fmu,
        model_of,
        models_in,
        recorded_of,
        with_standard,
    )
    from pysim.workflow.own_law import LawPlace, TypedLaw, effect_class, typed_law
    from pysim.workflow.session import SessionParts, effects_of, named, open_session, session_of, session_parts
    from pysim.workflow.shell import command_line
    from pysim.workflow.variants import Variants

_FILES = {
    "answer": ("whole_answer",),
    "data": ("BY_DATA", "data_of", "described_at", "reference_of"),
    "export": ("export_model",),
    "extended": ("write_extended",),
    "fitting": ("Initial", "beginning", "fit_problem", "fitted", "initial_values"),
    "free": ("free_parameters", "suggested"),
    "learned": ("class_name_of", "keep_law", "law_file", "with_classes"),
    "model": ("ModelInside", "class_in", "inside", "is_fmu", "model_of", "models_in", "recorded_of", "with_standard"),
    "own_law": ("LawPlace", "TypedLaw", "effect_class", "typed_law"),
    "session": ("SessionParts", "effects_of", "named", "open_session", "session_of", "session_parts"),
    "shell": ("command_line",),
    "variants": ("Variants",),
}
__all__ = [
    "BY_DATA",
    "Initial",
    "LawPlace",
    "ModelInside",
    "SessionParts",
    "TypedLaw",
    "Variants",
    "beginning",
    "class_in",
    "class_name_of",
    "command_line",
    "data_of",
    "described_at",
    "effect_class",
    "effects_of",
    "export_model",
    "fit_problem",
    "fitted",
    "free_parameters",
    "initial_values",
    "inside",
    "is_fmu",
    "keep_law",
    "law_file",
    "model_of",
    "models_in",
    "named",
    "open_session",
    "recorded_of",
    "reference_of",
    "session_of",
    "session_parts",
    "suggested",
    "typed_law",
    "whole_answer",
    "with_classes",
    "with_standard",
    "write_extended",
]


def __getattr__(name: str) -> Any:
    for file, names in _FILES.items():
        if name in names:
            return getattr(import_module(f"{__name__}.{file}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
