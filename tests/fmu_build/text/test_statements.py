"""Statements as a tree."""

from fmu_build.text.statements import Statement, statements
from fmu_build.text.tokens import tokenise

TEXT = """
  Real x = if a then 1 else 2;
equation
  x = if a then {b, if c then 1 else 2} else d;
  if if a then b else c then
    connect(p, q) annotation(Line(points = {{1, 2}}));
  elseif d then
    for i in 1:size(x, 1) loop when e then f = 1; elsewhen g then f = 2; end when; end for;
  else
  end if;
public
  Real y;
initial equation
  assert(true, "; end if;");
"""


def shape(statement: Statement) -> str:
    inside = "".join(f" [{' '.join(map(shape, branch))}]" for branch in statement.branches)
    return f"{statement.word}{inside}"


def test_branches_hold_their_statements() -> None:
    found = list(statements(tokenise(TEXT)))
    assert [shape(s) for s in found] == ["x", "if [connect] [for [when [f] [f]]] []", "assert"]
    assert [" ".join(token.text for token in c) for c in found[1].conditions] == ["if a then b else c", "d"]
    assert TEXT[found[1].start : found[1].end].split()[-3:] == ["else", "end", "if;"]


def test_text_that_ends_too_early_is_read_to_its_end() -> None:
    assert [shape(s) for s in statements(tokenise("equation if a then x = 1"))] == ["if [x]"]
