"""Names of variables as FMI's convention "structured" has them, which is Modelica's."""

import re

from fmu_build.errors import BuildError

# FMI 2.0.4, section 2.2.9, whose grammar FMI 3.0 keeps; names as there
_Q_NAME = r"'(?:[\w!#$%&()*+,\-./:;<>=?@\[\]^{}|~ ]|\\['\"?\\abfnrtv])+'"
_B_NAME = rf"(?:[A-Za-z_]\w*|{_Q_NAME})"
_INDICES = r"(?:\[\d+(?:,\d+)*\])?"  # arrayIndices
_IDENTIFIER = rf"{_B_NAME}{_INDICES}(?:\.{_B_NAME}{_INDICES})*"
_NAME = re.compile(rf"{_IDENTIFIER}|der\({_IDENTIFIER}(?:,\d+)?\)", re.ASCII)


def structured(name: str) -> str:
    """The name itself.

    Raises:
        BuildError: it breaks the convention, so that importers need not take it.
    """
    if _NAME.fullmatch(name) is None:
        raise BuildError(
            f"FMI does not allow the variable name {name}; use letters a to z, digits and underscores, or quote it as "
            "'name' with characters of ASCII."
        )
    return name
