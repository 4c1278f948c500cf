"""What every FMU has to pass, whoever compiled it."""

from pathlib import Path

from fmu_build.errors import BuildError


def validate_own(path: Path) -> None:
    """FMPy's validation but for the names of variables, which the emitter has checked: they are half of its time.

    Raises:
        BuildError: what it finds.
    """
    from fmpy import read_model_description
    from fmpy.model_description import ValidationError

    try:
        read_model_description(str(path), validate=True, validate_model_structure=True)
    except ValidationError as error:
        raise _invalid(error.problems) from error


def validate_foreign(path: Path) -> None:
    """FMPy's validation of the model description against the schema and the standard's rules.

    Raises:
        BuildError: what it finds.
    """
    from fmpy.validation import validate_fmu

    problems = validate_fmu(str(path))
    if problems:
        raise _invalid(problems)


def _invalid(problems: list[str]) -> BuildError:
    return BuildError("the FMU does not pass FMPy's validation: " + " ".join(problems))
