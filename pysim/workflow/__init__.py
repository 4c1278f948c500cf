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
    from pysim.workflow.data import BY_DATA, data_of, reference_of
    from pysim.workflow.extended import write_extended
    from pysim.workflow.fitting import fit_problem
    from pysim.workflow.free import free_parameters
    from pysim.workflow.learned import keep_law, law_file, with_classes
    from pysim.workflow.model import ModelInside, inside, is_fmu, model_of
    from pysim.workflow.session import SessionParts, effects_of, open_session, session_of, session_parts
    from pysim.workflow.shell import command_line
    from pysim.workflow.variants import Variants

_FILES = {
    "data": ("BY_DATA", "data_of", "reference_of"),
    "extended": ("write_extended",),
    "fitting": ("fit_problem",),
    "free": ("free_parameters",),
    "learned": ("keep_law", "law_file", "with_classes"),
    "model": ("ModelInside", "inside", "is_fmu", "model_of"),
    "session": ("SessionParts", "effects_of", "open_session", "session_of", "session_parts"),
    "shell": ("command_line",),
    "variants": ("Variants",),
}
__all__ = [
    "BY_DATA",
    "ModelInside",
    "SessionParts",
    "Variants",
    "command_line",
    "data_of",
    "effects_of",
    "fit_problem",
    "free_parameters",
    "inside",
    "is_fmu",
    "keep_law",
    "law_file",
    "model_of",
    "open_session",
    "reference_of",
    "session_of",
    "session_parts",
    "with_classes",
    "write_extended",
]


def __getattr__(name: str) -> Any:
    for file, names in _FILES.items():
        if name in names:
            return getattr(import_module(f"{__name__}.{file}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
