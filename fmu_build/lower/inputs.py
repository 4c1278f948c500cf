"""What an importer sets: the value an input is declared with is only where it starts."""

from collections.abc import Sequence

from fmu_build.errors import BuildError
from fmu_build.lower.ode_model import Variable
from fmu_build.lower.table import Entry


def check_inputs(rows: Sequence[Variable], entries: Sequence[Entry]) -> None:
    """Check that every input starts from a number; `entries` tell where each is declared.

    Raises:
        BuildError: the first input that is declared with a value that parameters do not give.
    """
    for row, entry in zip(rows, entries, strict=True):
        if row.causality == "input" and row.start is None:
            span = entry.variable.flat.span
            raise BuildError(
                f"the input {row.name} is declared with a value that is not one of parameters alone, while an input "
                'is set from outside; take "input" away, or the value',
                span.file,
                span.line,
            )
