"""Names of SSP 1.0 and of what stands in its annotations."""

from __future__ import annotations

import re

SSD = "http://ssp-standard.org/SSP1/SystemStructureDescription"
SSC = "http://ssp-standard.org/SSP1/SystemStructureCommon"
SSV = "http://ssp-standard.org/SSP1/SystemStructureParameterValues"
OSP = "http://opensimulationplatform.com/SSP/OSPAnnotations"  # how libcosim is told its step
RUN = "urn:pysim:cosim:run"  # what `read_ssp` finds again of a run; other tools pass over it

DESCRIPTION = "SystemStructure.ssd"

# Exponents of kg, m, s, A and rad.
_BASE = {
    "1": (0, 0, 0, 0, 0),
    "%": (0, 0, 0, 0, 0),
    "s": (0, 0, 1, 0, 0),
    "Hz": (0, 0, -1, 0, 0),
    "rad": (0, 0, 0, 0, 1),
    "m": (0, 1, 0, 0, 0),
    "kg": (1, 0, 0, 0, 0),
    "Pa": (1, -1, -2, 0, 0),
    "N": (1, 1, -2, 0, 0),
    "W": (1, 2, -3, 0, 0),
    "J": (1, 2, -2, 0, 0),
    "V": (1, 2, -3, -1, 0),
    "A": (0, 0, 0, 1, 0),
}
_WORD = re.compile(r"([A-Za-z%1]+)(-?\d+)?")


def base_unit(unit: str) -> dict[str, str] | None:
    """Attributes of the BaseUnit element, as "N.m/rad" or "kg/m3" make them; None where the unit is not understood."""
    total = [0] * 5
    above, _, below = unit.partition("/")
    for sign, words in ((1, above), (-1, below)):
        for word in filter(None, re.split(r"[.*()]", words)):
            match = _WORD.fullmatch(word)
            if match is None or match[1] not in _BASE:
                return None
            power = sign * int(match[2] or 1)
            total = [t + power * e for t, e in zip(total, _BASE[match[1]], strict=True)]
    found = {name: str(power) for name, power in zip(("kg", "m", "s", "A", "rad"), total, strict=True) if power}
    return {**found, "factor": "0.01"} if unit.startswith("%") else found
