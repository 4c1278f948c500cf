"""The best linear approximation (BLA) from periodic records, by one of three methods."""

from __future__ import annotations

from pysim.identify.multisine.assemble import POOLED_LINES, amplitude_of, assemble, hertz
from pysim.identify.multisine.levels import on_free_lines
from pysim.identify.multisine.linear_part import first_gain, over_free_lines, over_neighbours, over_realisations
from pysim.identify.multisine.lines import Harmonics, Lines, chosen_lines
from pysim.identify.multisine.periods import Periods, refuse_still
from pysim.identify.multisine.statistics import pooled
from pysim.identify.multisine.steady import DropPeriods, LocalTransient, SteadySpectra, Transient
from pysim.types import BadInput, BestLinearApproximation


def robust_approximation(
    periods: Periods, *, excited: Harmonics | None = None, transient: Transient | None = None
) -> BestLinearApproximation:
    """The BLA from M >= 2 realisations of the random phases, without assumptions on lines or smoothness of the gain.

    Args:
        periods: P >= 2 periods of each realisation separate noise from distortion.
        excited: harmonic numbers; None finds them in the command's spectrum.
        transient: how the initial transient is removed; None: `LocalTransient()`, or not at all for a single period.
    Raises:
        BadInput: one realisation, records that do not excite the same lines, or a constant output.
    """
    return _robust(*_prepare(periods, excited, transient))


def _robust(spectra: SteadySpectra, lines: Lines) -> BestLinearApproximation:
    return assemble(spectra, lines, over_realisations(spectra, lines), "robust: over realisations")


def fast_approximation(
    periods: Periods, *, excited: Harmonics | None = None, transient: Transient | None = None
) -> BestLinearApproximation:
    """The BLA from one realisation with odd excited lines, of which some are left out (free), and P >= 2 periods.

    Output on free lines is distortion: of even powers on even lines, of odd powers on odd lines. Input power that the
    actuator puts on free lines passes the linear part, which is subtracted with the interpolated gain.

    Args, Raises: as `robust_approximation`; also BadInput if even lines are excited, if no odd ones are free, or if
        only one period remains after removal of the transient.
    """
    return _fast(*_prepare(periods, excited, transient))


def _fast(spectra: SteadySpectra, lines: Lines) -> BestLinearApproximation:
    if not lines.are_odd or lines.odd.size < 2:
        raise BadInput(
            "fast method: needs a multisine of odd lines with some of them left free; use the robust method with "
            "several realisations, or the local polynomial method"
        )
    gain = first_gain(spectra, lines)
    on_odd_lines = on_free_lines(spectra, lines, lines.odd, gain, amplitude_of(spectra, lines))
    if on_odd_lines is None:
        raise BadInput(
            "fast method: the one period left does not tell noise from distortion; record more, or leave out fewer"
        )
    around = pooled(on_odd_lines, hertz(spectra, lines), POOLED_LINES)
    part = over_free_lines(spectra, lines, around.power, around.degrees)
    return assemble(spectra, lines, part, "fast: from lines left free", on_lines=around)


def smooth_approximation(
    periods: Periods,
    *,
    excited: Harmonics | None = None,
    transient: Transient | None = None,
    order: int = 2,
    width: int = 9,
) -> BestLinearApproximation:
    """The BLA from one realisation with any excited lines: the gain is a polynomial over neighbouring lines.

    Args, Raises: as `robust_approximation`; order and width as `over_neighbours`.
    """
    return _smooth(*_prepare(periods, excited, transient), order, width)


def _smooth(spectra: SteadySpectra, lines: Lines, order: int = 2, width: int = 9) -> BestLinearApproximation:
    part = over_neighbours(spectra, lines, order=order, width=width)
    return assemble(spectra, lines, part, f"local polynomial: order {order} over {width} excited lines")


def best_linear_approximation(
    periods: Periods, *, excited: Harmonics | None = None, transient: Transient | None = None
) -> BestLinearApproximation:
    """The BLA by the best method for these records: robust with several realisations; fast with free odd lines and an
    estimate of the noise; otherwise the local polynomial method."""
    spectra, lines = _prepare(periods, excited, transient)
    if spectra.values.shape[0] > 1:
        return _robust(spectra, lines)
    parted = lines.are_odd and lines.odd.size > 1 and spectra.noise is not None
    return _fast(spectra, lines) if parted else _smooth(spectra, lines)


def _prepare(periods: Periods, excited: Harmonics | None, transient: Transient | None) -> tuple[SteadySpectra, Lines]:
    lines = chosen_lines(periods, excited)
    if transient is None:
        transient = LocalTransient() if periods.values.shape[1] > 1 else DropPeriods(0)
    spectra = transient.spectra(periods)
    refuse_still(spectra.periods.values[..., 1], periods.names[1])
    return spectra, lines
