"""The numbers of the diagnosis, each with its unit, meaning and source. Gains and costs are log-likelihoods in nats."""

from __future__ import annotations

from dataclasses import dataclass

from pysim.types.setting import setting


@dataclass(frozen=True)
class Settings:
    """How effects are searched for, and when one is kept."""

    false_alarm: float = setting(
        1e-3, unit="1", meaning="p-value, times the number of effects tried, below which a gain is significant",
        source="measured: no effect named on 72 complete models with coloured noise",
    )  # fmt: skip
    on_trial: int = setting(
        2, unit="1", meaning="forward steps in a row that may join the model without being significant",
        source="measured: a friction and a drag that explain nothing alone, and much together",
    )  # fmt: skip
    small: float = setting(
        0.02, unit="1", meaning="share of the possible gain that steps on trial must reach, or the search ends",
        source="Mallows 1973, Technometrics 15:661: less is not worth its parameters",
    )  # fmt: skip
    near: float = setting(
        1.5, unit="1", meaning="residual over its noise floor, below which screening may drop effects",
        source="measured: first-order gains are wrong by a factor of 2 at most there",
    )  # fmt: skip
    first_order_error: float = setting(
        4.0, unit="1", meaning="factor by which a first-order gain may be too small near the noise floor",
        source="measured: twice the largest factor seen",
    )  # fmt: skip
    sure: float = setting(
        2.0, unit="1", meaning="standard deviations above the threshold at which an effect is surely found",
        source="one effect in forty is missed",
    )  # fmt: skip
    finalists: int = setting(
        3, unit="1", meaning="candidates per step that are refitted to the end", source="measured: known-answers"
    )
    heat: int = setting(
        3, unit="1", meaning="iterations of each refit before candidates are compared with each other",
        source="measured: iterations to within a tenth of the gain",
    )  # fmt: skip
    least_gain: float = setting(
        0.5, unit="1", meaning="nats below which finer integration, or another round of smoothing, is not worth it",
        source="what a parameter costs that is wrong by one standard deviation",
    )  # fmt: skip
    promising: float = setting(
        0.5, unit="1", meaning="share of the best expected gain above which a refit goes on",
        source="measured: expected gains are wrong by less",
    )  # fmt: skip
    tie: float = setting(
        2.0, unit="1", meaning="standard deviations of the difference of two gains, within which two models are tied",
        source="Vuong 1989, Econometrica 57:307",
    )  # fmt: skip
    decidable: float = setting(
        10.0, unit="1", meaning="effective sample size less the number of parameters, below which nothing is decided",
        source="chosen: with 4 or fewer, the F distribution has no finite variance",
    )  # fmt: skip
    held_out: float = setting(
        1.05, unit="1", meaning="error of a log over that of the others, above which more is missing",
        source="measured: complete models with coloured noise",
    )  # fmt: skip
    fine: float = setting(
        0.1, unit="1", meaning="integration error over the noise floor, above which the integration is refined",
        source="adds half a percent to the residual",
    )  # fmt: skip
    patience: int = setting(
        100, unit="1", meaning="integration steps over those of the base model's longest run, that stop a run",
        source="measured: a pump with play takes 10 times as many, at a tolerance of 1e-8",
    )  # fmt: skip
    refinements: int = setting(3, unit="1", meaning="tenfold refinements of the integration at most", source="to 1e-8")
    unexplained: float = setting(
        0.5, unit="1", meaning="residual over the signal's standard deviation, above which no model is complete",
        source="a fit percent of 50: with less, the model hardly describes the plant",
    )  # fmt: skip
    seen_share: float = setting(
        0.1, unit="1", meaning="share of what an effect changes, above which a block of data sees the effect",
        source="more than twice the average, as there are 24 blocks",
    )  # fmt: skip
    seen_blocks: int = setting(
        3, unit="1", meaning="blocks that must see an effect before left-out blocks may veto it",
        source="two blocks have no scatter to speak of",
    )  # fmt: skip
    follows_t: float = setting(
        3.0, unit="1", meaning="t statistic above which the model's own signals predict the residual",
        source="a chance of 0.1 %",
    )  # fmt: skip
    believable: float = setting(
        4.0, unit="1", meaning="standard deviations of its prior, above which a sensor error is not believable",
        source="Box 1980, Journal of the Royal Statistical Society A 143:383; a chance of 6e-5",
    )  # fmt: skip
    beyond: float = setting(
        0.05, unit="1", meaning="share of its size by which an effect may press against its bound and be believable",
        source="bounds are round numbers, or limits that a law has by itself, such as a share of 1",
    )  # fmt: skip
    max_effects: int = setting(
        4, unit="1", meaning="effects that are added to a model at most", source="more say nothing to a reader"
    )


@dataclass(frozen=True)
class LearnSettings:
    """How laws are learned that no catalogue has."""

    knots: int = setting(
        15, unit="1", meaning="knots of a curve, two beyond the logs", source="measured: nine within miss a dead band"
    )
    most_knots: int = setting(
        57, unit="1", meaning="knots of a curve at most", source="measured: known-answers, a magnet beside the way"
    )
    least: float = setting(
        0.05, unit="1", meaning="share of the avoidable sum of squares that a law must explain to be kept, and that "
        "effects must leave of the base model's before a law is learned",
        source="measured: bench-16, where a leakage explains 2 % of a shaft's tone",
    )  # fmt: skip
    near: float = setting(
        0.8, unit="1", meaning="share of the best score in the screening, above which a law is refitted",
        source="measured: in trials, the right place was always above it",
    )  # fmt: skip
    unseats: float = setting(
        0.1, unit="1", meaning="share of the avoidable sum of squares that a law must explain beyond an effect, to "
        "replace it", source="measured: trials",
    )  # fmt: skip
    folds: int = setting(
        5, unit="1", meaning="parts of the logs that are left out in turn at most, if no log may choose",
        source="Breiman and Spector 1992, International Statistical Review 60:291",
    )  # fmt: skip
    sign_width: float = setting(
        0.02, unit="1", meaning="width of a smooth sign's change, over its variable's root mean square",
        source="chosen: one sample in a hundred of a sine lies within",
    )  # fmt: skip
    bristles: tuple[float, ...] = setting(
        (0.3, 0.1, 0.03), unit="1",
        meaning="lengths of a bristle that are screened, over the mean way from one reversal to the next",
        source="a third of a decade apart; a shorter one is as good as a sign",
    )  # fmt: skip
    phases: int = setting(
        4, unit="1", meaning="phases of a tone that are screened, over half a turn",
        source="the nearest one explains 85 % or more of the best one's squares",
    )  # fmt: skip
    most: int = setting(8, unit="1", meaning="laws that are refitted at most", source="measured: trials")
    heat: int = setting(
        4, unit="1", meaning="iterations of a law between updates of its smoothness", source="measured: trials"
    )


@dataclass(frozen=True)
class TestSettings:
    """Which tests are considered to separate two models, and when they are enough."""

    enough: float = setting(
        50.0, unit="1", meaning="expected difference of the models' sums of squares over the noise that settles a tie",
        source="three times 16, whose half is two standard deviations of that half (`Settings.tie`)",
    )  # fmt: skip
    most: int = setting(3, unit="1", meaning="tests in a plan at most", source="more is a campaign of its own")
    repeats: int = setting(4, unit="1", meaning="runs of one test at most", source="half the noise")
    parts: tuple[int, int] = setting(
        (2, 4), unit="1", meaning="parts of the command's range: if it is on one side of zero, and on both",
        source="two mean values on each side",
    )  # fmt: skip
    side: float = setting(
        0.1, unit="1", meaning="share of its largest size that a command must reach on a side of zero to count there",
        source="less is noise of the command",
    )  # fmt: skip
    amplitudes: tuple[float, ...] = setting(
        (0.2, 1.0), unit="1", meaning="amplitudes of a sine, over half the width of its part of the range",
        source="laws that depend on the amplitude differ between them",
    )  # fmt: skip
    frequencies: int = setting(6, unit="1", meaning="frequencies of sines, in equal ratios", source="three a decade")
    periods: int = setting(3, unit="1", meaning="whole periods of a sine at least", source="the first is for settling")
    samples: int = setting(300, unit="1", meaning="samples of a sine at least", source="50 for each of six parameters")
    peaks: tuple[float, ...] = setting(
        (0.4, 0.7), unit="1", meaning="peaks of waves: logarithmic shares of the way from lowest to highest frequency",
        source="the spectrum falls to a tenth at twice its peak, and stays within the band",
    )  # fmt: skip
    height: float = setting(
        0.8, unit="1", meaning="significant height of a wave, over half the command's range",
        source="Longuet-Higgins 1952: of 200 waves the highest is 1.6 times as high",
    )  # fmt: skip
    wave: int = setting(2000, unit="1", meaning="samples of a wave", source="as in the thesis")
    wait: int = setting(10_000, unit="1", meaning="samples of a run that shows the settling time", source="five waves")
    still: float = setting(
        0.2, unit="1", meaning="share of its noise within which a signal is settled", source="a hundred samples hide it"
    )
    unlogged: float = setting(
        1e-3, unit="1", meaning="noise of a signal never logged, over its range", source="IEC 60770-1: class 0.1"
    )
    errors: float = setting(
        10.0, unit="1", meaning="noise of a signal never logged, over its integration error, at least",
        source="with less, the integration error would count as evidence",
    )  # fmt: skip
    readable: float = setting(
        0.1, unit="1", meaning="noise over range, above which a signal is not worth logging", source="nothing is read"
    )
    seed: int = setting(1, unit="1", meaning="random seed of waves", source="convention")
