"""Figures as bytes, and the drawings of a result as files."""

from __future__ import annotations

from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True)
class Picture:
    """A figure of a result.

    Args:
        name: of its files, without a suffix.
        caption: a sentence, which also serves readers who cannot see it.
        section: of the page that it belongs to, where a page has several.
    """

    name: str
    caption: str
    figure: Figure
    section: str = ""


@dataclass(frozen=True)
class Drawing:
    """A picture once it is drawn, as a page takes it in."""

    name: str
    caption: str
    svg: bytes
    section: str = ""


def render(figure: Figure, form: str) -> bytes:
    """The figure as "png" (150 dots per inch) or "svg"."""
    buffer = BytesIO()
    metadata = {"Date": None} if form == "svg" else {"Software": None}
    figure.savefig(buffer, format=form, dpi=150, metadata=metadata)
    return buffer.getvalue()


def draw(picture: Picture, folder: Path) -> Drawing:
    """Write a picture into the folder as PNG and SVG."""
    from pysim.io import write_file

    write_file(folder / f"{picture.name}.png", render(picture.figure, "png"))
    picture.figure.set_layout_engine("none")  # found by the first drawing
    svg = render(picture.figure, "svg")
    write_file(folder / f"{picture.name}.svg", svg)
    return Drawing(picture.name, picture.caption, svg, picture.section)
