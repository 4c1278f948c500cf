"""The numbers of the diagnosis, each with its unit, its meaning and its source."""

from __future__ import annotations

from dataclasses import dataclass

from pysim.types.setting import setting


@dataclass(frozen=True)
class Settings:
    """How effects are searched for, and when one is named."""

    false_alarm: float = setting(
        1e-3, unit="1", meaning="chance of naming an effect where none is missing, all that was tried counted",
        source="measured: no name on 72 complete models with coloured noise",
    )  # fmt: skip
    on_trial: int = setting(
        2, unit="1", meaning="steps that may follow each other without being significant",
        source="measured: a friction and a drag that are worth nothing alone",
    )  # fmt: skip
    small: float = setting(
        0.02, unit="1", meaning="share of what can be gained below which steps on trial are not worth it",
        source="Mallows 1973, Technometrics 15:661: less does not pay for its parameters",
    )  # fmt: skip
    near: float = setting(
        1.5, unit="1", meaning="levels over their white floor below which first-order gains put candidates aside",
        source="measured: there they err by 2 at most",
    )  # fmt: skip
    first_order_error: float = setting(
        4.0, unit="1", meaning="factor by which a first-order gain may be too small near the floor",
        source="measured: twice the largest seen",
    )  # fmt: skip
    sure: float = setting(
        2.0, unit="1", meaning="standard deviations beyond its threshold from which on an effect is sure to be seen",
        source="one in forty is missed",
    )  # fmt: skip
    finalists: int = setting(
        3, unit="1", meaning="candidates of a step that are refitted to the end", source="measured: known-answers"
    )
    heat: int = setting(
        3, unit="1", meaning="points that a refit is given before the candidates are compared",
        source="measured: steps to within a tenth of the gain",
    )  # fmt: skip
    anew: float = setting(
        0.5, unit="1", meaning="nats: a search that begins anew where it ended has to gain as much to go on",
        source="what a parameter costs that is off by a standard deviation",
    )  # fmt: skip
    promising: float = setting(
        0.5, unit="1", meaning="share of the best expected gain from which on a refit goes on",
        source="measured: what a refit still promises errs by less",
    )  # fmt: skip
    tie: float = setting(
        2.0, unit="1", meaning="standard deviations of the difference of two gains that make a tie",
        source="Vuong 1989, Econometrica 57:307",
    )  # fmt: skip
    decidable: float = setting(
        10.0, unit="1", meaning="independent samples beyond the parameters below which nothing is decided",
        source="below it the F distribution has no variance to speak of",
    )  # fmt: skip
    held_out: float = setting(
        1.05, unit="1", meaning="error on logs not fitted over that on those fitted, up to which a model is complete",
        source="measured: coloured nulls",
    )  # fmt: skip
    fine: float = setting(
        0.1, unit="1", meaning="error of the integration over the floor, above which it is refined",
        source="adds half a percent to what is left",
    )  # fmt: skip
    patience: int = setting(
        100, unit="1", meaning="steps over those of the base model's longest run, after which a run is given up",
        source="measured: a pump with a play takes 10 times those, at 1e-8",
    )  # fmt: skip
    refinements: int = setting(3, unit="1", meaning="tenfold refinements at most", source="to 1e-8, near rounding")
    unexplained: float = setting(
        0.5, unit="1", meaning="residual over the signal's standard deviation from which on no model is complete",
        source="half of fit percent: less is no description of the plant",
    )  # fmt: skip
    seen_share: float = setting(
        0.1, unit="1", meaning="share of what an effect does, from which on a block of data sees it",
        source="a block is a twenty-fourth: more than twice its part",
    )  # fmt: skip
    seen_blocks: int = setting(
        3, unit="1", meaning="blocks that see an effect, below which blocks left out say nothing of it",
        source="two have no scatter to speak of",
    )  # fmt: skip
    follows_t: float = setting(
        3.0, unit="1", meaning="standard deviations from which on a residual follows the model's own signals",
        source="a chance of 0.1 %",
    )  # fmt: skip
    believable: float = setting(
        4.0, unit="1", meaning="standard deviations of its prior beyond which an error is none of a sensor",
        source="Box 1980, Journal of the Royal Statistical Society A 143:383; a chance of 6e-5",
    )  # fmt: skip
    beyond: float = setting(
        0.05, unit="1", meaning="share of its size by which an effect may want to pass its bound and still be believed",
        source="bounds of classes are round numbers, or ends that a law has by itself, as a share of 1",
    )  # fmt: skip
    max_effects: int = setting(
        4, unit="1", meaning="effects in a model at most", source="more have no name to a reader"
    )


@dataclass(frozen=True)
class LearnSettings:
    """How laws that no catalogue has are learned."""

    knots: int = setting(
        13, unit="1", meaning="of a curve in the screening", source="measured: nine miss a valve's dead band; bench-03"
    )
    most_knots: int = setting(
        49, unit="1", meaning="of a curve that is kept", source="measured: known-answers, a magnet beside the way"
    )
    least: float = setting(
        0.05, unit="1", meaning="share of the avoidable sum of squares below which a law is no answer",
        source="measured: bench-16, where a tone of the shaft lends a leakage 2 %",
    )  # fmt: skip
    near: float = setting(
        0.8, unit="1", meaning="share of the best score from which on a law is refitted",
        source="measured: trial, the right place within it each time",
    )  # fmt: skip
    unseats: float = setting(
        0.1, unit="1", meaning="share of the avoidable sum of squares by which a law must do better than an effect to "
        "unseat it", source="measured: trial",
    )  # fmt: skip
    sign_width: float = setting(
        0.02, unit="1", meaning="width of a sign's change over its variable's root mean square",
        source="chosen: of a sine one sample in a hundred lies within",
    )  # fmt: skip
    most: int = setting(8, unit="1", meaning="laws that are refitted at most", source="measured: trial")
    heat: int = setting(
        4, unit="1", meaning="points that each of them is given, smoothness fitted in between", source="measured: trial"
    )


@dataclass(frozen=True)
class TestSettings:
    """Which tests are looked at to separate two models, and when they are enough."""

    enough: float = setting(
        50.0, unit="1", meaning="expected difference of the sums of squares over noise that settles a tie",
        source="three times the 16 of which half is two standard deviations of itself (`Settings.tie`)",
    )  # fmt: skip
    most: int = setting(3, unit="1", meaning="tests in a plan at most", source="more is a campaign of its own")
    repeats: int = setting(4, unit="1", meaning="times that a test is repeated at most", source="half the noise")
    parts: tuple[int, int] = setting(
        (2, 4), unit="1", meaning="parts that the command's range is cut into: on one side of zero, and on both",
        source="a mean and an amplitude on each side",
    )  # fmt: skip
    side: float = setting(
        0.1, unit="1", meaning="share of its largest size that a command must reach on a side to count as there",
        source="less is noise of the command",
    )  # fmt: skip
    amplitudes: tuple[float, ...] = setting(
        (0.2, 1.0), unit="1", meaning="of a sine, over half the width of its part",
        source="laws that depend on the amplitude show between them",
    )  # fmt: skip
    frequencies: int = setting(6, unit="1", meaning="of sines, in equal ratios", source="three a decade")
    periods: int = setting(3, unit="1", meaning="whole periods of a sine at least", source="one is left to settle")
    samples: int = setting(300, unit="1", meaning="of a sine's log at least", source="50 for each of six parameters")
    peaks: tuple[float, ...] = setting(
        (0.4, 0.7), unit="1", meaning="peaks of waves between the lowest and the highest frequency, in logarithms",
        source="the spectrum falls to a tenth at twice its peak, and stays within the band",
    )  # fmt: skip
    height: float = setting(
        0.8, unit="1", meaning="significant height of a wave over half the command's range",
        source="Longuet-Higgins 1952: of 200 waves the highest is 1.6 times as high",
    )  # fmt: skip
    wave: int = setting(2000, unit="1", meaning="samples of a wave", source="as the thesis' waves")
    wait: int = setting(10_000, unit="1", meaning="samples in which a step must settle", source="five waves")
    still: float = setting(
        0.2, unit="1", meaning="noise within which a system counts as settled", source="a hundred samples hide it"
    )
    unlogged: float = setting(
        1e-3, unit="1", meaning="noise of a signal never logged, over its range", source="IEC 60770-1: class 0.1"
    )
    errors: float = setting(
        10.0, unit="1", meaning="noise of a signal that was never logged, over the error of its simulation at least",
        source="below it the error counts as evidence",
    )  # fmt: skip
    readable: float = setting(
        0.1, unit="1", meaning="noise over range from which on a signal is not worth logging", source="nothing is read"
    )
    seed: int = setting(1, unit="1", meaning="of waves", source="convention")


@dataclass(frozen=True)
class ToneSettings:
    """When one line of a residual's spectrum is a tone."""

    lobe: int = setting(
        2, unit="1", meaning="lines on either side that belong to a tone", source="main lobe of Hann's window"
    )
    beside: int = setting(
        8, unit="1", meaning="lines beyond them, on either side, that tell the level", source="noise is level there"
    )
    worth: int = setting(
        8, unit="1", meaning="independent lines that those are worth", source="half, as Hann's window joins two"
    )
    even: float = setting(
        0.01,
        unit="1",
        meaning="share by which a sampling interval may vary",
        source="half a percent of the shortest period",
    )
