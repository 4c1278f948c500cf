"""What a check of data found, to read and to type."""

from __future__ import annotations

from dataclasses import dataclass

from pysim.identify.data_check import DataCheck, Finding

_SHOWN = 1900  # letters


@dataclass(frozen=True, repr=False)
class Check:
    """Print it, and type its lines.

    Args:
        result: with all numbers.
    """

    result: DataCheck

    @property
    def findings(self) -> tuple[Finding, ...]:
        """Each a code with its values, and the steps that cure it: `data.after(*found.cure)`."""
        return self.result.findings

    @property
    def ok(self) -> bool:
        """Whether nothing was found."""
        return not self.findings

    @property
    def lines(self) -> tuple[str, ...]:
        """What to type, one after the other, to cure what preparation can."""
        from pysim.present.data_check import lines

        return lines(self.findings)

    def __repr__(self) -> str:
        from pysim.present.data_check import warnings_in_words

        shown = "\n".join(warnings_in_words(self.result))
        return shown if len(shown) <= _SHOWN else f"{shown[:_SHOWN]}..."

    def _repr_html_(self) -> str:
        from html import escape

        return f"<pre>{escape(repr(self))}</pre>"
