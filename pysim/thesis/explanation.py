"""Whether the misfit of Table 4.1 explains what our numbers differ by from Tables 4.7 and 4.8, number by number."""

from __future__ import annotations

from dataclasses import dataclass

from pysim.thesis.published import published_deviations
from pysim.types import Comparison

# Half a unit of the last printed digit of both tables, in dB and degrees
_ROUNDING = (0.01, 0.01, 0.1, 0.1)
# What may remain beyond misfit and rounding: the distance allowed from the independent simulation at a point, twice
TOLERANCE_DB, TOLERANCE_DEG = 0.05, 0.3


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
        in the maximum (triangle inequality). That holds where both comparisons are at the same frequencies; those of
        the thesis are not printed, so that this is an assumption.
        """
        terms = zip(self.ours, self.printed, self.misfit, _ROUNDING, strict=True)
        return tuple(max(0.0, abs(a - b) - misfit - rounding) for a, b, misfit, rounding in terms)

    @property
    def explained(self) -> bool:
        """Whether the excess is within the tolerance."""
        return max(self.excess[:2]) <= TOLERANCE_DB and max(self.excess[2:]) <= TOLERANCE_DEG


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
    other = [_name(row) for row in rows if row.passes != row.printed_passes]
    return [
        f"Table {table} compares the model with measured points, this page with the transfer functions fitted to those "
        "points; the points were not published.",
        f"Where: the largest phase deviation is {_range(ours, 3, 0)} deg here, {_range(printed, 3, 0)} deg in "
        f"Table {table}. The other three numbers differ by "
        f"{_largest(ours, printed, 0):.2f} dB, {_largest(ours, printed, 1):.2f} dB and "
        f"{_largest(ours, printed, 2):.1f} deg at most.",
        f"What may cause it: the fits have five poles and no dead time. By Table 4.4 they are up to "
        f"{_range(misfit, 3, 0)} deg and {_range(misfit, 1, 2)} dB away from the measured points, test by test; a "
        "model close to the fit is about that much away from the points.",
        "Assumption: both comparisons are at the same frequencies. The thesis does not print its own, and what follows "
        "holds only as far as they are like those of this page.",
        _conclusion(rows),
        f"Verdicts that differ from Table {table}: {', '.join(other) if other else 'none'}.",
    ]


def _conclusion(rows: tuple[Difference, ...]) -> str:
    """What the numbers allow to say, one way or the other."""
    bound = (
        "Is that all? By the triangle inequality the two comparisons may differ by the fit's own misfit, number by "
        f"number. Beyond it and the rounding of the printed tables, {TOLERANCE_DB:g} dB and {TOLERANCE_DEG:g} deg are "
        "tolerated; "
    )
    beyond = [row for row in rows if not row.explained]
    if beyond:
        named = ", ".join(
            f"{_name(row)} (by {max(row.excess[:2]):.2f} dB, {max(row.excess[2:]):.1f} deg)" for row in beyond
        )
        return (
            f"{bound}{len(beyond)} of {len(rows)} tests differ by more: {named}. There, the misfit of the fits does "
            "not explain the difference; model, parameters or frequencies are not those of the thesis."
        )
    return (
        f"{bound}{max(max(row.excess[:2]) for row in rows):.2f} dB and {max(max(row.excess[2:]) for row in rows):.1f} "
        f"deg remain at most over {len(rows)} tests. The misfit of the fits can explain every difference, which does "
        "not prove that it is the cause."
    )


def _name(row: Difference) -> str:
    return f"{row.offset:g}/{row.amplitude:g}"


def _range(values: list[tuple[float, ...]], column: int, digits: int) -> str:
    numbers = [row[column] for row in values]
    return f"{min(numbers):.{digits}f} to {max(numbers):.{digits}f}"


def _largest(a: list[tuple[float, ...]], b: list[tuple[float, ...]], column: int) -> float:
    return max(abs(x[column] - y[column]) for x, y in zip(a, b, strict=True))
