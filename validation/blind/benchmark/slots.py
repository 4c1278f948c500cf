"""In which slot of the pump each effect sits, read from the catalogue."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from pysim.effects import STANDARD_LIBRARY, read_catalogue

SLOTS: Mapping[str, str] = MappingProxyType({e.name: e.slot for e in read_catalogue(STANDARD_LIBRARY)})
