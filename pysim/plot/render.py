"""Figures as bytes."""

from __future__ import annotations

from io import BytesIO

from matplotlib.figure import Figure


def render(figure: Figure, form: str) -> bytes:
    """The figure as "png" (150 dots per inch) or "svg"."""
    buffer = BytesIO()
    metadata = {"Date": None} if form == "svg" else {"Software": None}
    figure.savefig(buffer, format=form, dpi=150, metadata=metadata)
    return buffer.getvalue()
