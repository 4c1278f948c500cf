"""What every FMU has to pass, whoever compiled it."""

from pathlib import Path

from fmu_build.errors import BuildError


def validate(path: Path) -> None:
    """FMPy's validation of the model description against the schema and the standard's rules.

    Raises:
        BuildError: what it finds.
    """
    from fmpy.validation import validate_fmu

    problems = validate_fmu(str(path))
    if problems:
        raise BuildError("the FMU does not pass FMPy's validation: " + " ".join(problems))
