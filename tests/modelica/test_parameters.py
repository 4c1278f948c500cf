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


def test_identified_values() -> None:
    for record, table in (("FreeGreyBox", "table_4_6_free"), ("LockedGreyBox", "table_4_5_locked")):
        body = re.search(r"extends GreyBox\((.*?)\);", read("Data", f"{record}.mo"), re.DOTALL)
        assert body
        values = dict(item.split("=") for item in re.sub(r"\s", "", body[1]).split(","))
        assert list(values) == IDENTIFIED
        for name, text in values.items():
            assert value_of(text) == pytest.approx(TABLES[table][name] * SI[TABLES["units"][name]], rel=1e-12), name


def test_bounds_of_table_4_6() -> None:
    source = read("Pump", "SwashPlateControl.mo")
    for name in IDENTIFIED:
        declared = re.search(rf"parameter Types\.\w+ {name}\(min=([^,]*), max=([^,)]*)", source)
        assert declared, name
        limits = [TABLES[f"table_4_6_{end}"][name] for end in ("lower", "upper")]
        factor = SI[TABLES["units"][name]]
        assert [value_of(text) for text in declared.groups()] == pytest.approx(
            [limit * factor for limit in limits], rel=1e-12
        ), name
        for table in ("table_4_6_free", "table_4_5_locked"):
            assert limits[0] <= TABLES[table][name] <= limits[1], (name, table)


def test_static_values() -> None:
    source = read("Data", "StaticParameters.mo")
    for name, (value, unit) in TABLES["table_5"].items():
        declared = re.search(rf"^  Types\.\w+ {name} = ([^\"]*) \"", source, re.MULTILINE)
        assert declared, name
        assert value_of(declared[1]) == pytest.approx(value * SI[unit], rel=1e-12), name


@pytest.mark.parametrize("name", ["SwashPlateControl", "FreeGreyBox", "LockedGreyBox"])
def test_pump_has_the_names_of_appendix_f_and_each_identified_parameter_is_free(name: str) -> None:
    """The value comes from the constant record alone, so that it can be set without touching another."""
    variables = compiled(f"HydraulicTestBench.Pump.{name}").to_dict("flat")["variables"]
    for table, names in TABLES["appendix_F"].items():
        assert set(names) - set(variables) == set(), table
    for parameter in IDENTIFIED if name != "SwashPlateControl" else ():
        variable = variables[parameter]
        binding = variable["binding"] or variable["start"]
        assert "Parameter" in variable["variability"]
        assert binding["VarRef"]["name"]["name"] == f"data.{parameter}"
        assert "Constant" in variables[f"data.{parameter}"]["variability"]
