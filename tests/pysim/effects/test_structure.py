"""How a model's parts hang together: our pump as its diagram has it, a model of equations, one with many parts."""

from pathlib import Path

import pytest

from pysim.effects import STANDARD_LIBRARY, slots
from pysim.effects.structure import Structure, structure
from tests.toy import library

PUMP = "HydraulicTestBench.Pump.FreeGreyBox"

DRIVE = """
package Drive
  partial model PartialTorque
    input Real w;
    output Real tau;
  end PartialTorque;
  model NoTorque extends PartialTorque; equation tau = 0; end NoTorque;
  model Drive
    parameter Real J = 1;
    input Real u "Command";
    output Real y;
    Real e;
    Real passed = u;
    Real unused;
    Real w(start=0, fixed=true);
    replaceable NoTorque shaft constrainedby PartialTorque;
  equation
    e = passed - y;
    der(w) = (e - shaft.tau)/J;
    shaft.w = w;
    y = if w > 1 then 1 else w;
    unused = w;
  end Drive;
end Drive;
"""
CROWDED = "model Crowded input Real u; output Real y; {} equation {} y = x1 + x2; end Crowded;"


def written(text: str, folder: Path) -> list[Path]:
    """A library in a file."""
    (folder / "a.mo").write_text(text)
    return [folder / "a.mo"]


def links(found: Structure) -> set[str]:
    """As "a -> b", and with the names in order "a <-> b" or "a -- b"."""
    sign = {"both": " <-> ", "joint": " -- "}
    one_way = {f"{link.source} -> {link.target}" for link in found.links if link.kind == "to"}
    others = [link for link in found.links if link.kind != "to"]
    return one_way | {sign[link.kind].join(sorted((link.source, link.target))) for link in others}


def test_a_pump_has_every_slot_and_the_links_of_its_diagram() -> None:
    found = structure(PUMP, [STANDARD_LIBRARY])
    kinds = {node.name: node.kind for node in found.nodes}
    assert {slot.name for slot in slots(PUMP, [STANDARD_LIBRARY])} == {n for n, k in kinds.items() if k == "slot"}
    assert [n for n, k in kinds.items() if k == "term"] == []  # names of the thesis for what parts have: none is drawn
    drawn = links(found)
    for link in ("angleError -> card", "card -> cardOutput", "spoolOpening -> valve", "angleSensor -> angleError"):
        assert link in drawn
    assert "piston <-> pistonForce" in drawn
    assert "alphaCMD -> angleError" in drawn  # through alphaRef
    assert "chamber1 -- valve" in drawn


def test_equations_of_the_class_are_drawn_as_what_they_give(tmp_path: Path) -> None:
    found = structure("Drive.Drive", written(DRIVE, tmp_path))
    assert {node.name: node.kind for node in found.nodes} == {
        "u": "input", "y": "output", "e": "term", "w": "term", "shaft": "slot",
    }  # fmt: skip
    assert links(found) == {"u -> e", "y -> e", "e -> w", "shaft <-> w", "w -> y"}


def test_a_mass_with_a_slot() -> None:
    drawn = links(structure("Toy.Mass", [library()]))
    assert drawn == {"F -> v", "v <-> x", "x -> force", "force <-> v"}  # the spring: x acts on v


@pytest.mark.parametrize(("count", "name"), [(14, "x3"), (15, "Crowded")])
def test_too_many_equations_are_one_place(tmp_path: Path, count: int, name: str) -> None:
    names = range(1, count + 1)
    declared = " ".join(f"Real x{k}(start=0, fixed=true);" for k in names)
    laws = " ".join(f"der(x{k}) = u - x{k} + x{k % count + 1};" for k in names)
    found = structure("Crowded", written(CROWDED.format(declared, laws), tmp_path))
    assert name in [node.name for node in found.nodes]
    assert (len(found.nodes) == 3) == (count > 14)
