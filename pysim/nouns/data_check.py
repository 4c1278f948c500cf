"""What a check of data found, to read and to type."""

from __future__ import annotations

from dataclasses import dataclass

from pysim.identify.data_check import DataCheck, Finding, FindingCode
from pysim.identify.data_check.finding import finding
from pysim.io.prepare import Scaled
from pysim.types import Dataset, Model

_SHOWN = 1900  # letters
_FACTORS = {("%", "1"): 0.01, ("1", "%"): 100.0}  # between units that are the same quantity, and are kept apart


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


def other_quantities(dataset: Dataset, model: Model) -> tuple[Finding, ...]:
    """Findings of signals whose unit must be mended ahead of a simulation: of inputs that the model counts in another
    quantity, and of shares in % and 1, whose factor no simulation has to tell."""
    known, found = {v.name: v for v in model.variables}, []
    for signal in dataset.signals:
        variable = known.get(signal.variable)
        logs = [record.source for record in dataset.logs() if signal.name in dataset.columns(record, signal.role)]
        if variable is None or not logs or model.scale(variable, signal.unit) is not None:
            continue
        factor = _FACTORS.get((signal.unit, variable.unit))
        if factor is not None or variable.causality == "input":
            told = {"signal": signal.name, "unit": signal.unit, "wanted": variable.unit}
            cure = () if factor is None else (Scaled(signal.name, factor, 0.0, variable.unit, signal.unit),)
            found.append(finding(FindingCode.QUANTITY, logs[0], *cure, **told))
    return tuple(found)
