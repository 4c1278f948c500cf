"""What a reader of a result must know, as data: a code and its numbers. Words are made where results are shown."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum

from pysim.types._frozen import FrozenMapping


class NoteCode(Enum):
    """What is said. The keys of `Note.values` that belong to it stand behind it."""

    NOISE_ESTIMATED = "noise_estimated"  # dataset, signal, value, unit: not specified, estimated from the data
    NOISE_ASSUMED = "noise_assumed"  # dataset, magnitude (dB), phase (deg): of tables that state none
    NOT_COMPARED = "not_compared"  # record: no column of it is
    NOT_WIRED = (
        "not_wired"  # outputs of controllers that go nowhere, inputs that nothing drives; output, input: the first
    )
    NOT_SETTLED = "not_settled"  # record, others (how many more): its first period is unlike those after it
    NOT_SIMULATED = "not_simulated"  # record, reason (what the run said): the model could not be run through it
    NOT_TRIED = "not_tried"  # effect, reason; and beside what, where it was tried beside less
    HELD = "held"  # parameter: the data do not determine it, intervals hold it where it stands
    AT_BOUND = "at_bound"  # parameter, bound, value, unit
    BEYOND_BOUND = "beyond_bound"  # effect: it gains, and is not named since it would end beyond its bounds
    POOR_FIT = "poor_fit"  # signal, factor: its residual over its noise
    INTERCHANGEABLE = "interchangeable"  # parameter -> exponent, "@spread", "@low" and "@high"
    CORRELATED = "correlated"  # first, second, correlation: two estimates that are hardly told apart
    NOT_AT_REST = "not_at_rest"  # record: a log that does not begin at rest, as it was taken
    USED_TO_CHOOSE = "used_to_choose"  # records: chose between models, and no others are held out
    INTERVAL_CONDITIONAL = "interval_conditional"  # intervals hold for the model that was chosen only
    TABLES_LEFT_OUT = "tables_left_out"  # count: of tables of responses, beside logs over time
    HELD_AS_SET = "held_as_set"  # parameters: set, so not refitted, though the model gives them bounds
    BUILT_WITH = "built_with"  # parameters: an FMU was built with values that its class does not have
    NO_EFFECT_FITS = "no_effect_fits"  # model: no slot of it takes an effect of the libraries
    CLASS_UNKNOWN = "class_unknown"  # model: its class is in none of the libraries
    SEEN_FROM_OUTSIDE = "seen_from_outside"  # model, inputs, outputs, states: all that can be seen of a closed FMU
    INTERVAL_WIDTHS = "interval_widths"  # parameter: how many times as wide as for white residuals, each
    FEW_BLOCKS = "few_blocks"  # fewest: the data have fewer independent stretches than intervals need
    SEARCH_GAVE_UP = "search_gave_up"  # evaluations
    BEYOND_NOISE = "beyond_noise"  # factor: residuals over what the noise explains
    DEAD_TIME_AT_BOUND = "dead_time_at_bound"  # end ("smallest" or "largest"), seconds
    DEAD_TIME_AMBIGUOUS = "dead_time_ambiguous"  # seconds: turns the phase by more than the frequencies resolve
    EDGE_OF_STABILITY = "edge_of_stability"  # a pole is held there
    INTEGRATOR = "integrator"  # frequency (Hz) of a pole that may be one
    UNSTABLE = "unstable"  # count, poles: so many of the poles
    NOT_DETERMINED = "not_determined"  # names: of coefficients that the data leave open
    CANCELLING = "cancelling"  # pole, zero (Hz): alike within their errors
    UNBOUNDED = "unbounded"  # parameters: refitted without bounds on both sides, since nothing gives any
    NO_NEXT_TEST = "no_next_test"  # reason: no test that would settle a tie was looked for
    NO_LAW = "no_law"  # law: the best of those in no catalogue, which gains no more than chance would
    LAW_VETOED = "law_vetoed"  # law: the same, which makes the error worse on data that were not fitted
    NO_LAW_RUNS = "no_law_runs"  # places: the model could be simulated with no law at any of them
    LAWS_NOT_TRIED = "laws_not_tried"  # effects: their events leave no slopes to look for laws with
    TRANSIENTS = "transients"  # seconds: so soon after a sine's start does the fitted period begin
    NO_HARMONICS = "no_harmonics"  # begin, end (s): samples are lost, so that only the sine itself can be fitted
    FEW_HARMONICS = (
        "few_harmonics"  # begin, end (s), kept, count: samples are lost, so that harmonics cannot be told apart
    )
    DRIFTING = "drifting"  # percent: a sine changes within the fitted part
    MEMORY = "memory"  # the residuals have one; intervals follow their spectrum
    MEMORY_IN_HARMONICS = "memory_in_harmonics"  # the same, seen in the harmonics of a single period
    HARMONICS = "harmonics"  # count, points, frequency (Hz), percent: beyond the noise, and where most
    LOST_IN_NOISE = "lost_in_noise"  # frequency (Hz): from where on a chirp's tops and bottoms are
    FAST_SWEEP = "fast_sweep"  # frequency (Hz): below it a chirp is no steady sine
    FEW_SAMPLES = "few_samples"  # samples: per period at a chirp's high end
    OTHER = "other"  # text: of a program part that has no codes yet


@dataclass(frozen=True)
class Note:
    """One thing to know.

    Args:
        code: what is said.
        values: numbers and names it is said of, by the keys that stand at the code.
    """

    code: NoteCode
    values: Mapping[str, float | str]

    def __post_init__(self) -> None:
        object.__setattr__(self, "values", FrozenMapping(self.values))

    def __hash__(self) -> int:
        return hash((self.code, frozenset(self.values.items())))
