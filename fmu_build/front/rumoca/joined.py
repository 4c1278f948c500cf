"""Several single files as one text, because rumoca takes one text beside its library folders."""

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from fmu_build.text.classes import ClassText
from fmu_build.text.libraries import read_text

WRAPPER = "OverridesOfThisBuild"  # the class that sets values, or names a class of a library


@dataclass(frozen=True)
class JoinedText:
    """The text, and the files it is made of: parts[k] begins at line starts[k], counted from 1."""

    text: str
    starts: tuple[int, ...]
    parts: tuple[Path, ...]

    def place(self, line: int) -> tuple[Path, int]:
        """File and line of a line of the text."""
        k = max(bisect_right(self.starts, line) - 1, 0)
        return self.parts[k], line - self.starts[k] + 1


def join(source: ClassText, libraries: Sequence[Path]) -> JoinedText:
    """The class's own file first, where it is a single one, then every other single file of the libraries."""
    file = source.source.file
    texts = [(file, source.source.text)] if file in libraries else []
    texts += [(library, read_text(library)) for library in libraries if library.is_file() and library != file]
    starts, line = [], 1
    for _, text in texts:
        starts.append(line)
        line += text.count("\n") + 1
    return JoinedText("\n".join(text for _, text in texts), tuple(starts), tuple(file for file, _ in texts))
