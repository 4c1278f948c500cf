"""From rumoca's byte spans to file and line."""

import re
from bisect import bisect_right
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from fmu_build.front.expression import Span
from fmu_build.front.rumoca.joined import WRAPPER, JoinedText


class Places:
    """The text of all sources, by rumoca's source number."""

    def __init__(self, source_map: Mapping[str, Any]) -> None:
        self._files: dict[int, tuple[JoinedText, list[int]]] = {}
        for number, name, text in source_map["files"]:
            if not isinstance(name, JoinedText):
                if Path(name).stem == WRAPPER:  # nothing a user has written
                    continue
                name = JoinedText(text, (1,), (Path(name),))
            starts = [0]
            for line in text.encode().split(b"\n"):
                starts.append(starts[-1] + len(line) + 1)
            self._files[number] = (name, starts)

    def span(self, provenance: Mapping[str, Any] | None) -> Span:
        """The line a provenance record points at."""
        place = (provenance or {}).get("span")
        if not place or place["source"] not in self._files:
            return Span()
        text, starts = self._files[place["source"]]
        return Span(*text.place(bisect_right(starts, place["start"])))

    def is_outer(self, provenance: Mapping[str, Any] | None) -> bool:
        """Whether the declared name that a record points at stands behind the word `outer`."""
        place = (provenance or {}).get("span")
        if not place or place["source"] not in self._files:
            return False
        before = self._files[place["source"]][0].text.encode()[: place["start"]]
        return re.search(rb'\bouter\b[^;"]*\Z', before) is not None


def span_key(provenance: Mapping[str, Any] | None) -> tuple[int, int, int]:
    """Identity of a place in the text, the same in rumoca's flat and DAE form."""
    place = (provenance or {}).get("span") or {"source": -1, "start": -1, "end": -1}
    return place["source"], place["start"], place["end"]
