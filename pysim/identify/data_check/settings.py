"""The numbers of the data check, each with its unit, its meaning and its source."""

from __future__ import annotations

from dataclasses import dataclass

from pysim.types.setting import setting


@dataclass(frozen=True)
class LogCheckSettings:
    """When a log shows an error by itself."""

    fewest_samples: int = setting(
        20, unit="1", meaning="samples of a log, and of a stretch between two that are cut out, at least",
        source="chosen: fewer do not show a response",
    )  # fmt: skip
    slow_rate: float = setting(
        1.0, unit="Hz", meaning="sampling rate up to which the times of a log are probably in another unit than s",
        source="chosen: 1 kHz with times in ms",
    )  # fmt: skip
    jitter: float = setting(
        0.05, unit="1", meaning="jitter over the sampling interval, above which a log is unevenly sampled",
        source="chosen: 3 % of a sine's amplitude where it has ten samples a period",
    )  # fmt: skip
    fewest_periods: float = setting(
        2.0, unit="1", meaning="whole periods of a stepped sine after its lead-in, at least",
        source="chosen: a sine fit needs them once transients are cut off",
    )  # fmt: skip
    drift: float = setting(
        0.02, unit="1", meaning="periods by which command and specified frequency may differ over a log",
        source="chosen: 7 degrees at its end",
    )  # fmt: skip
    level_error: float = setting(
        0.01, unit="1", meaning="share of the specified amplitude by which the command's offset and amplitude may "
        "differ from the specified ones", source="chosen: 0.09 dB",
    )  # fmt: skip
    impure: float = setting(
        0.02, unit="1", meaning="residual of the command's sine fit over the sine, both root mean squares, above which "
        "the command is no pure sine", source="chosen: 34 dB below the sine",
    )  # fmt: skip
    poor_fit: float = setting(
        0.1, unit="1", meaning="the same from which on the fit also starts at the spectrum's strongest frequency",
        source="chosen: five times `impure`",
    )  # fmt: skip
    no_sine: float = setting(
        1.0, unit="1", meaning="the same from which on the fitted frequency is not compared with the specified one",
        source="chosen: the sine then explains half of the command's variance",
    )  # fmt: skip
    padding: int = setting(
        8, unit="1", meaning="length of the padded log over that of the log in the spectrum where a sine fit starts",
        source="chosen: starts within a sixteenth of a line",
    )  # fmt: skip
    iterations: int = setting(
        20, unit="1", meaning="steps of a sine's frequency at most", source="chosen: they converge quadratically"
    )
    longest_step: float = setting(
        0.25, unit="1", meaning="longest step of a sine's frequency, in periods over the log",
        source="chosen: a quarter of a line of the spectrum",
    )  # fmt: skip
    near_nyquist: float = setting(
        0.8, unit="1", meaning="share of half the sampling rate, above which power may be aliased",
        source="chosen: a fifth of the band",
    )  # fmt: skip
    folded: float = setting(
        0.01, unit="1", meaning="share of a signal's variance in that band, above which it counts as aliased; with a "
        "larger share of missing samples, none is checked for it", source="chosen: a tenth of the signal's size",
    )  # fmt: skip
    clear_power: float = setting(
        5.0, unit="1", meaning="power of a signal beyond its noise, in standard deviations of the noise's power, up "
        "to which it counts as noise", source="chosen: noise hardly reaches it by chance",
    )  # fmt: skip
    fewest_in_spectrum: int = setting(
        16, unit="1", meaning="samples of a signal that is checked for aliasing, at least",
        source="chosen: two lines in the band",
    )  # fmt: skip
    most_cuts: int = setting(
        3, unit="1", meaning="clipped stretches that are cut out one by one; with more, the whole log is left out",
        source="chosen",
    )  # fmt: skip
    fewest_equal: int = setting(
        4, unit="1", meaning="equal samples of a plateau at a signal's extreme value, at least", source="chosen"
    )
    runs_beside: int = setting(
        6, unit="1", meaning="runs of equal samples on either side of a plateau that show how noisy a signal is",
        source="chosen: a chirp is slow in other parts",
    )  # fmt: skip
    noisy_run: float = setting(
        1.5, unit="1", meaning="mean length of these runs in samples, below which the signal is noisy",
        source="chosen: it then changes at nearly every sample",
    )  # fmt: skip
    clipped_step: float = setting(
        1.5, unit="1", meaning="step into or out of a plateau over the smallest step, above which a signal is clipped",
        source="chosen: a signal that comes to rest changes by single quantisation steps",
    )  # fmt: skip
    fewest_changes: int = setting(
        20, unit="1", meaning="changes of an input that show steps, at least", source="chosen"
    )
    changes_per_jump: int = setting(
        2, unit="1", meaning="the same over the number of its jumps", source="chosen: at most every other is a jump"
    )
    held_share: float = setting(
        0.9, unit="1", meaning="share of an input's changes with an equal sample ahead, from which on it may be held",
        source="chosen: it hardly ever changes at two samples in a row",
    )  # fmt: skip
    unlike_rounding: float = setting(
        2.5, unit="1", meaning="median over smallest change of an input, above which it is more than rounded",
        source="chosen: a rounded signal changes by one digit",
    )  # fmt: skip


@dataclass(frozen=True)
class ModelCheckSettings:
    """When logs show an error beside a model's simulation of them."""

    follows: float = setting(
        0.7, unit="1", meaning="absolute correlation from which on a signal follows the simulated one, or its negative",
        source="chosen: the simulated one then explains half of its variance",
    )  # fmt: skip
    alike: float = setting(
        0.8, unit="1", meaning="share of a signal's largest absolute correlation in any log, from which on a log shows "
        "its sign though it does not follow",
        source="chosen: a model that follows one log by 0.7 may follow others by 0.6",
    )  # fmt: skip
    tone: float = setting(
        0.1, unit="1", meaning="share of a simulated signal's power beside its strongest line, below which it is one "
        "sine", source="chosen: a wrong resonance turns a sine as a wrong sign does",
    )  # fmt: skip
    lobe: int = setting(
        2, unit="1", meaning="lines on either side that belong to the strongest one; a sine has more periods than that",
        source="main lobe of Hann's window",
    )  # fmt: skip
    turned_tone: float = setting(
        0.95, unit="1", meaning="absolute correlation from which on the sign of such a sine is wrong all the same",
        source="chosen: its phase is then beyond 162 degrees",
    )  # fmt: skip
    moves: float = setting(
        0.05, unit="1", meaning="share of a signal's largest simulated motion in any log, up to which a log shows no "
        "sign or unit", source="chosen",
    )  # fmt: skip
    clear: float = setting(
        12.0, unit="1", meaning="swing of a signal in standard deviations of its noise, up to which it may be noise",
        source="chosen: three times the swing of noise alone",
    )  # fmt: skip
    tail: float = setting(
        0.02, unit="1", meaning="share of the samples that a swing leaves out at either end", source="chosen: outliers"
    )
    near_factor: float = setting(
        1.5, unit="1", meaning="ratio to a factor between units, below which a gain counts as that factor",
        source="chosen: the model's own gain may be wrong",
    )  # fmt: skip
    beyond_effects: float = setting(
        10.0, unit="1", meaning="ratio of measured and simulated swing, above which a unit is wrong whether or not the "
        "signal follows", source="chosen: friction, a dead band or a leak takes a part of a motion, and no more",
    )  # fmt: skip
    beyond_rest: float = setting(
        100.0, unit="1", meaning="factor above which a unit is wrong though another log of the signal is right",
        source="chosen: `beyond_effects` squared, for a plant that hardly moves in one log, as in its dead band",
    )  # fmt: skip
    rough: float = setting(
        0.2, unit="1", meaning="power of a factor by which the swing of a signal that does not follow may miss it",
        source="chosen: of 1e5 as much as `beyond_effects`",
    )  # fmt: skip
    no_offset: float = setting(
        0.02, unit="1", meaning="share of a simulated signal's range, below which the offset of a raw sensor value is "
        "set to 0", source="chosen",
    )  # fmt: skip
    swapped: float = setting(
        0.5, unit="1", meaning="what two signals lack in absolute correlation with their names swapped, over what they "
        "lack as they are, up to which they are swapped", source="chosen: half",
    )  # fmt: skip
    swapped_level: float = setting(
        0.1, unit="1", meaning="misfit of two signals with their names swapped, over that as they are, below which "
        "they are swapped", source="chosen",
    )  # fmt: skip
    one_cause: float = setting(
        2.0, unit="1", meaning="misfit with one input turned, or two names swapped, over that with all outputs turned, "
        "below which this one step is the likelier cause", source="chosen: one error is likelier than several",
    )  # fmt: skip
    one_output: float = setting(
        0.5, unit="1", meaning="the same where one output is turned alone", source="chosen: this is as likely a cause"
    )
