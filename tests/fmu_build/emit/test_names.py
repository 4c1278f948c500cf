"""Names of variables: what FMI's grammar takes, and what it does not. FMPy has a parser of that grammar."""

from types import SimpleNamespace

import pytest
from fmpy.validation import _validate_variable_names

from fmu_build.emit.names import structured
from fmu_build.errors import BuildError

GOOD = [
    "x",
    "_x9",
    "pump.spool[2].dp",
    "table[1,12].y[3]",
    "der(pump.x)",
    "der(x[3],2)",
    "'event indicator'[1]",
    "a.'quoted name: 1+2'.b",
    r"'it\'s'",
    "'der(x)'",
]
BAD = [
    "",
    "9x",
    "a b",
    "ä",
    "a..b",
    "a.",
    "a[]",
    "a[1",
    "a[1][2]",
    "a[-1]",
    "a[i]",
    "der(x",
    "der(der(x))",
    "der(x, 2)",
    "der(x).y",
    "''",
    "'a'b'",
    "'ä'",
    "'a",
    "x\n",
    "$probe",
    "x٣",
]


def fmpy_objects(name: str) -> bool:
    variable = SimpleNamespace(name=name, sourceline=1)
    description = SimpleNamespace(variableNamingConvention="structured", modelVariables=[variable])
    return bool(_validate_variable_names(description))


@pytest.mark.parametrize("name", GOOD)
def test_names_of_the_grammar_are_taken(name: str) -> None:
    assert structured(name) == name
    assert not fmpy_objects(name)


@pytest.mark.parametrize("name", BAD)
def test_other_names_are_refused_with_the_cure(name: str) -> None:
    with pytest.raises(BuildError, match="FMI does not allow the variable name"):
        structured(name)
    assert fmpy_objects(name)
