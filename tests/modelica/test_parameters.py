"""The numbers of the library against the thesis' tables, transcribed apart from it."""

import ast
import json
import math
import operator
import re
from pathlib import Path

import pytest

from tests.modelica.library import LIBRARY, compiled

TABLES = json.loads((Path(__file__).parent / "thesis_tables.json").read_text(encoding="utf-8"))
SI = {"Hz": 2 * math.pi, "1": 1, "s": 1, "kg": 1, "kg/m3": 1, "mm": 1e-3, "mm2": 1e-6, "dm3": 1e-3, "N/mm": 1e3}
SI |= {"Ns/mm": 1e3, "ms": 1e-3, "MPa": 1e6, "bar": 1e5, "deg": math.pi / 180}
IDENTIFIED = list(TABLES["units"])
OPERATORS = {ast.Mult: operator.mul, ast.Div: operator.truediv}


def value_of(expression: str) -> float:
    """Value of a product or quotient of numbers and Constants.pi."""

    def value(node: ast.expr) -> float:
        match node:
            case ast.Constant(value=number):
                return float(number)
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return -value(operand)
            case ast.BinOp(left=left, op=op, right=right):
                return OPERATORS[type(op)](value(left), value(right))
            case ast.Attribute(attr="pi"):
                return math.pi
        raise ValueError(f"{expression} is no product of numbers")

    return value(ast.parse(expression.strip(), mode="eval").body)


def read(*parts: str) -> str:
    return LIBRARY.joinpath(*parts).read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("record", "table"), [("FreeGreyBox", "table_4_6_free"), ("LockedGreyBox", "table_4_5_locked")]
)
def test_identified_values(record: str, table: str) -> None:
    body = re.search(r"extends GreyBox\((.*?)\);", read("Data", f"{record}.mo"), re.DOTALL)
    assert body
    values = dict(item.split("=") for item in re.sub(r"\s", "", body[1]).split(","))
    assert list(values) == IDENTIFIED
    for name, text in values.items():
        assert value_of(text) == pytest.approx(TABLES[table][name] * SI[TABLES["units"][name]], rel=1e-12), name


@pytest.mark.parametrize("name", IDENTIFIED)
def test_bounds_of_table_4_6(name: str) -> None:
    declared = re.search(
        rf"parameter Types\.\w+ {name}\(min=([^,]*), max=([^,)]*)", read("Pump", "SwashPlateControl.mo")
    )
    assert declared
    factor = SI[TABLES["units"][name]]
    assert value_of(declared[1]) == pytest.approx(TABLES["table_4_6_lower"][name] * factor, rel=1e-12)
    assert value_of(declared[2]) == pytest.approx(TABLES["table_4_6_upper"][name] * factor, rel=1e-12)


@pytest.mark.parametrize("name", IDENTIFIED)
@pytest.mark.parametrize("table", ["table_4_6_free", "table_4_5_locked"])
def test_values_lie_within_the_bounds(name: str, table: str) -> None:
    assert TABLES["table_4_6_lower"][name] <= TABLES[table][name] <= TABLES["table_4_6_upper"][name]


@pytest.mark.parametrize("name", list(TABLES["table_5"]))
def test_static_values(name: str) -> None:
    declared = re.search(rf"^  Types\.\w+ {name} = ([^\"]*) \"", read("Data", "StaticParameters.mo"), re.MULTILINE)
    assert declared
    value, unit = TABLES["table_5"][name]
    assert value_of(declared[1]) == pytest.approx(value * SI[unit], rel=1e-12)


@pytest.mark.parametrize("name", ["SwashPlateControl", "FreeGreyBox", "LockedGreyBox"])
def test_names_of_appendix_f_exist(name: str) -> None:
    variables = set(compiled(f"HydraulicTestBench.Pump.{name}").to_dict("flat")["variables"])
    for table, names in TABLES["appendix_F"].items():
        assert set(names) - variables == set(), table


@pytest.mark.parametrize("name", ["FreeGreyBox", "LockedGreyBox"])
def test_each_identified_parameter_is_free(name: str) -> None:
    """Its value comes from the constant record alone, so that it can be set without touching another."""
    variables = compiled(f"HydraulicTestBench.Pump.{name}").to_dict("flat")["variables"]
    for parameter in IDENTIFIED:
        variable = variables[parameter]
        binding = variable["binding"] or variable["start"]
        assert "Parameter" in variable["variability"]
        assert binding["VarRef"]["name"]["name"] == f"data.{parameter}"
        assert "Constant" in variables[f"data.{parameter}"]["variability"]
