"""Why a comparison with Table 4.1 cannot give the numbers of Tables 4.7 and 4.8, checked number by number."""

from __future__ import annotations

from dataclasses import dataclass

from pysim.types import Comparison
from validation.thesis.published import published_deviations

# Half a unit of the last printed digit of both tables, in dB and degrees
_ROUNDING = (0.01, 0.01, 0.1, 0.1)


@dataclass(frozen=True)
class Difference:
    """One test: our four numbers, the thesis' own, and what Table 4.4 says of the transfer function between them."""

    offset: float
    amplitude: float
    ours: tuple[float, ...]
    printed: tuple[float, ...]
    misfit: tuple[float, ...]
    passes: bool
    printed_passes: bool

    @property
    def excess(self) -> tuple[float, ...]:
        """How far each number differs by more than misfit and rounding can explain; zero where they explain it.

        |model - measured| and |model - fit| differ by |fit - measured| at most, at each frequency, so in the mean and
        in the maximum (triangle inequality).
        """
        terms = zip(self.ours, self.printed, self.misfit, _ROUNDING, strict=True)
        return tuple(max(0.0, abs(a - b) - misfit - rounding) for a, b, misfit, rounding in terms)


def differences(comparison: Comparison, table: str) -> tuple[Difference, ...]:
    """Our comparison with Table 4.1 beside the thesis' comparison with its measurements.

    Args:
        comparison: tests at the thesis' offsets and amplitudes; those whose run failed are left out.
        table: "4.7" for the locked set, "4.8" for the free set.
    """
    printed = {(row.offset, row.amplitude): row for row in published_deviations(table)}
    misfit = {(row.offset, row.amplitude): row.values for row in published_deviations("4.4")}
    rows = []
    for response in comparison.tests:
        if response.deviations:
            test = response.measured.test
            theirs = printed[test.offset, test.amplitude]
            ours = tuple(deviation.value for deviation in response.deviations)
            own = misfit[test.offset, test.amplitude]
            both = (response.passes, theirs.passes)
            rows.append(Difference(test.offset, test.amplitude, ours, theirs.values, own, *both))
    return tuple(rows)


def explain(rows: tuple[Difference, ...], table: str) -> list[str]:
    """In words, where and why our numbers differ from a table of the thesis, with the figures that show it."""
    if not rows:
        return []
    ours, printed, misfit = ([getattr(row, name) for row in rows] for name in ("ours", "printed", "misfit"))
    excess_db = max(max(row.excess[:2]) for row in rows)
    excess_deg = max(max(row.excess[2:]) for row in rows)
    other = [f"{row.offset:g}/{row.amplitude:g}" for row in rows if row.passes != row.printed_passes]
    return [
        f"Table {table} compares the model with measured points, this page with the transfer functions fitted to those "
        "points; the points were not published.",
        f"Where: most of all in the largest phase deviation, {_range(ours, 3)} deg here, {_range(printed, 3)} deg in "
        f"Table {table}. The other three numbers differ by "
        f"{_largest(ours, printed, 0):.2f} dB, {_largest(ours, printed, 1):.2f} dB and "
        f"{_largest(ours, printed, 2):.1f} deg at most.",
        f"Why: the fits have five poles and no dead time, and are {_range(misfit, 3)} deg away from the measured phase "
        "at most (Table 4.4). The tables agree when that is near 30 Hz, the pump lagging more than its fit: a model "
        "close to the fit is that much away from the pump. In magnitude the fits are 0.6 to 2 dB off at most, "
        "up to the whole limit of Table 1.3.",
        f"Is that all? By the triangle inequality the two comparisons may differ by the fit's own misfit, number by "
        f"number. Beyond it, and beyond the rounding of the printed tables, there remain {excess_db:.2f} dB and "
        f"{excess_deg:.1f} deg at most over {len(rows)} tests; by these numbers, this can be the thesis' model.",
        f"Verdicts that differ from Table {table}: {', '.join(other) if other else 'none'}.",
    ]


def _range(values: list[tuple[float, ...]], column: int) -> str:
    numbers = [row[column] for row in values]
    return f"{min(numbers):.0f} to {max(numbers):.0f}"


def _largest(a: list[tuple[float, ...]], b: list[tuple[float, ...]], column: int) -> float:
    return max(abs(x[column] - y[column]) for x, y in zip(a, b, strict=True))
