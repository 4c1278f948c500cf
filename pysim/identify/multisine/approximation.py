"""The best linear approximation from periodic records, by any of three methods."""

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
    """From M >= 2 realisations of the random phases: makes no assumption about the lines or the gain's smoothness.

    Args:
        periods: P >= 2 of each realisation tell noise from distortion.
        excited: harmonic numbers; found in the command's spectrum when not given.
        transient: how the start is kept out; `LocalTransient()` by default, nothing where there is one period.
    Raises:
        BadInput: one realisation, records that do not excite the same lines, or an output that stands still.
    """
    return _robust(*_prepare(periods, excited, transient))


def _robust(spectra: SteadySpectra, lines: Lines) -> BestLinearApproximation:
    return assemble(spectra, lines, over_realisations(spectra, lines), "robust: over realisations")


def fast_approximation(
    periods: Periods, *, excited: Harmonics | None = None, transient: Transient | None = None
) -> BestLinearApproximation:
    """From one realisation with odd excited lines, some odd lines left free, and P >= 2 periods.

    What appears on free lines is distortion: even powers on even lines, odd powers on odd ones. Power that the actuator
    itself puts on free lines goes through the linear part, and is taken off with the gain interpolated there.

    Args, Raises: as `robust_approximation`; and BadInput where even lines are excited or no odd ones are free, or where
        the transient's rule leaves one period.
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
    """From one realisation with any excited lines: the gain is a polynomial over neighbouring lines.

    Args, Raises: as `robust_approximation`; order and width as `over_neighbours`.
    """
    return _smooth(*_prepare(periods, excited, transient), order, width)


def _smooth(spectra: SteadySpectra, lines: Lines, order: int = 2, width: int = 9) -> BestLinearApproximation:
    part = over_neighbours(spectra, lines, order=order, width=width)
    return assemble(spectra, lines, part, f"local polynomial: order {order} over {width} excited lines")


def best_linear_approximation(
    periods: Periods, *, excited: Harmonics | None = None, transient: Transient | None = None
) -> BestLinearApproximation:
    """The method that these records allow: robust with several realisations, fast with odd lines left free and two
    periods that the transient's rule leaves, else the local polynomial method."""
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
