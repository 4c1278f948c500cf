"""The table of the mirror: as the thesis has it, as the page shows it, and able to see a wrong sign."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

from validation.mirror import case
from validation.mirror.blocks import BLOCKS, STATIC, Block

TABLES = Path(__file__).parents[2] / "modelica" / "thesis_tables.json"  # transcribed apart from BLOCKS
SIGNED = [block for block in BLOCKS if block.formula is not None and block.table in (7, 8, 10)]


def test_every_name_of_the_thesis_stands_in_the_table_once() -> None:
    printed = json.loads(TABLES.read_text(encoding="utf-8"))
    names = [*(name for table in printed["appendix_F"].values() for name in table), *printed["appendix_F_block"]]
    assert sorted(block.name for block in BLOCKS) == sorted(names)
    assert set(STATIC) == set(printed["table_5"])


def test_the_page_shows_the_table() -> None:
    page = Path(case.__file__).with_name("README.md").read_text(encoding="utf-8")
    assert case.table() in page


@pytest.mark.parametrize("block", SIGNED, ids=lambda block: block.name)
def test_a_turned_sign_would_be_seen(block: Block) -> None:
    formula = block.formula
    assert formula is not None
    turned = replace(block, formula=lambda rows: -formula(rows))
    assert case.off(block) <= block.tolerance
    assert case.off(turned) > 0.5
