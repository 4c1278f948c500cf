"""The numbers of a fit, each with its unit, its meaning and its source."""

from __future__ import annotations

from dataclasses import dataclass

from pysim.types.setting import setting


@dataclass(frozen=True)
class FitSettings:
    """How a least-squares search goes, and how its intervals are made."""

    tolerance: float = setting(
        0.05,
        unit="nats",
        meaning="a search ends where a full step would lower the objective by less: 0.3 standard deviations of the "
        "worst combination of parameters at most, and less with every step that was taken",
        source="measured: fit-cost, where five of eight points gained 6 of 23,685 below it",
    )
    max_iterations: int = setting(
        100, unit="1", meaning="points that one search tries", source="measured: fit-thesis needs 40"
    )
    first_radius: float = setting(
        0.5,
        unit="1",
        meaning="longest first step, in natural logarithms or shares of the scale",
        source="Nocedal and Wright 2006, Algorithm 4.1; half of the linear range of a logarithm",
    )
    rough: float = setting(
        3e-4,
        unit="1",
        meaning="tolerance of the integration on the way to the optimum",
        source="measured: fit-cost; over five starts a sixth less CPU than 1e-4, and the same end within the jumps of "
        "the cost",
    )
    near: float = setting(
        4e-3,
        unit="1",
        meaning="share of the sum of squares by which a step must still lower it while the integration is rough",
        source="measured: fit-cost",
    )
    blur: float = setting(
        2.5e-5,
        unit="1",
        meaning="share of the sum of squares within which two simulated costs are equal: the integration takes other "
        "steps from point to point",
        source="measured: fit-cost, where costs on one line jump by 0.3 of 23,300 at a tolerance of 1e-5",
    )
    close: float = setting(
        20.0,
        unit="1",
        meaning="tolerances: a search ends well where costs tell no better and a step that is not too long promises "
        "less",
        source="measured: fit-cost, where of such a promise a quarter came true in a curved valley",
    )
    spare: float = setting(
        0.05,
        unit="1",
        meaning="a step is the shortest that promises all but this share of what the best one does: what is nearly "
        "tied costs length and gains next to nothing",
        source="measured: fit-cost",
    )
    alike: float = setting(
        0.02,
        unit="1",
        meaning="share of the sum of squares by which rough searches may differ that are both gone on with",
        source="chosen: five times `near`, where a rough search ends",
    )
    level: float = setting(
        0.95, unit="1", meaning="of intervals", source="convention of the field; ISO/IEC Guide 98-3:2008, 6.2"
    )
    undetermined: float = setting(
        1e-2,
        unit="1",
        meaning="share of a direction without any slope from which on a parameter in it counts as not determined",
        source="measured: sensitivity",
    )
    apart: float = setting(
        1.5,
        unit="1",
        meaning="ratio of the interval from blocks to that from white noise from which on a note says so",
        source="Freedman 2006, The American Statistician 60:299: such a gap tells of a model that is wrong",
    )
    fewest_blocks: int = setting(
        8,
        unit="1",
        meaning="fewer blocks give no interval of their own",
        source="Bell and McCaffrey 2002, Survey Methodology 28:169",
    )


@dataclass(frozen=True)
class NoiseSettings:
    """What residuals are measured against, and what is allowed for beside the model."""

    whole: int = setting(
        200_000,
        unit="1",
        meaning="samples of a log, above which its rows become triangles while it is simulated",
        source="measured: fit-cost, memory",
    )
    blocks: int = setting(
        24,
        unit="1",
        meaning="pieces of the data that count as independent of each other",
        source="measured: fit-coverage",
    )
    piece: float = setting(
        5.0,
        unit="1",
        meaning="length of a stretch of a log that counts as independent, in memories of its residual",
        source="the correlation of neighbouring means is then below 1/5",
    )
    bands: int = setting(
        10, unit="1", meaning="equal bands of a residual's periodogram", source="measured: known-answers"
    )
    joined: float = setting(
        3.0,
        unit="1",
        meaning="standard deviations within which a band is as low as the lowest",
        source="a chance of 0.1 % for each band",
    )
    least: float = setting(
        1e-5,
        unit="1",
        meaning="share of a signal's range below which no residual counts",
        source="the relative error of the finest integration of a fit",
    )
    initial: float = setting(
        12**-0.5,
        unit="1",
        meaning="standard deviation of an initial state around rest, as a share of the state's range over its log",
        source="of a value that lies anywhere in the range",
    )
    gain_sd: float = setting(
        0.01, unit="1", meaning="expected error of a sensor's gain", source="IEC 60770-1: class 1 transmitters"
    )
    offset_sd: float = setting(
        0.005,
        unit="1",
        meaning="expected offset of a sensor, as a share of its full scale",
        source="IEC 60770-1: class 0.5 transmitters",
    )
    delay_sd: float = setting(
        0.25, unit="1", meaning="expected delay of a channel, in samples", source="clocks that are read at any time"
    )
    drift_sd: float = setting(
        0.005,
        unit="1",
        meaning="expected drift of a sensor from the first to the last record, as a share of its full scale",
        source="IEC 60770-1: as its offset",
    )


@dataclass(frozen=True)
class TrustSettings:
    """When a fit warns of itself."""

    poor: float = setting(
        1.5,
        unit="1",
        meaning="residual of a signal over its noise from which on a fit is called poor",
        source="intervals that take it for noise are then half as wide again",
    )
    correlated: float = setting(
        0.98,
        unit="1",
        meaning="correlation of two estimates from which on they are hardly distinguishable",
        source="one alone would be known five times as well: 1/sqrt(1 - r^2)",
    )
    vague: float = setting(
        0.05,
        unit="1",
        meaning="standard deviation of an estimate over its value, below which a correlation does no harm",
        source="the accuracy of a catalogue's data",
    )
    away: float = setting(
        0.1,
        unit="1",
        meaning="share of a state's range over its log by which it begins from rest, from which on that is said",
        source="measured: a mass that begins displaced, and logs that begin at rest stay below a fiftieth",
    )
    explained: float = setting(
        0.3,
        unit="1",
        meaning="share of a log's sum of squares that other initial states take off, from which on it did not begin at "
        "rest",
        source="measured: a missing friction leaves a sixth to them at most, noise a hundredth",
    )
    beginning: float = setting(
        0.05, unit="1", meaning="share of a log that counts as its beginning", source="a twentieth, a sample of blocks"
    )
    fewest: int = setting(10, unit="1", meaning="samples of a beginning at least", source="their rms is known to 22 %")
    apart: float = setting(
        3.0,
        unit="1",
        meaning="rms residual of a beginning over that of the rest, from which on the log did not begin at rest",
        source="three standard deviations of the noise, where the rest is noise",
    )


@dataclass(frozen=True)
class BeginningSettings:
    """How the state is found at which a log begins."""

    date: float = setting(
        1e6,
        unit="s",
        meaning="begin of a log from where on the clock is a date, and is set to begin with the first log",
        source="up to there a float64 tells 1e-10 s, which steps of a run need",
    )
    heads: int = setting(
        6,
        unit="1",
        meaning="stretches ahead of a whole log that begins anywhere, each twice as long as the one before",
        source="the first, a 64th, is a part of one swing where the log has sixty",
    )
    points: int = setting(
        10,
        unit="1",
        meaning="points of a search on one of these stretches, whose end is a start and no answer",
        source="chosen: a tenth of what a whole search may try",
    )
    rounds: int = setting(
        40, unit="1", meaning="steps of the initial states of a log that was not fitted", source="chosen: a pump took 7"
    )
    settled: float = setting(
        0.5,
        unit="nats",
        meaning="what a step of these must promise to be worth it",
        source="what a free number gains by chance in the mean (chi-squared of one degree over 2)",
    )


@dataclass(frozen=True)
class RestSettings:
    """How long a model is given to come to rest ahead of a log."""

    periods: float = setting(
        10.0,
        unit="1",
        meaning="periods of a table's slowest sine for which a model is watched, where no log says how long",
        source="chosen: what has not died away by then is seen in no table",
    )
    looks: int = setting(
        200,
        unit="1",
        meaning="times at which a disturbance is watched as it dies away, on a logarithmic scale",
        source="chosen: each is 5 % later than the one before",
    )
    earliest: float = setting(
        1e-4,
        unit="1",
        meaning="first of them, as a share of the longest log",
        source="chosen: less than a sample of most logs",
    )
    still: float = setting(
        1e-9,
        unit="1",
        meaning="share of its values that a model at rest may move by",
        source="chosen: some million roundings of a double",
    )
    settled: float = setting(
        0.01,
        unit="1",
        meaning="share of its largest effect on what is compared, below which a disturbance has died away",
        source="convention of the field: settling within one percent",
    )


@dataclass(frozen=True)
class SteadySettings:
    """When a stepped sine counts as steady, and which of its harmonics count."""

    unlike: float = setting(
        5.0,
        unit="1",
        meaning="standard deviations by which a log's first period may differ from those after it",
        source="a data set has some hundred numbers, and noise with memory puts more into slow ones than white noise",
    )
    also: float = setting(
        2.5,
        unit="1",
        meaning="the same where another log of the data set differs by more than that",
        source="chosen: half of it, for what one log shows the others are likely to have, too",
    )
    chance: float = setting(
        1e-3,
        unit="1",
        meaning="probability that a harmonic which is not there stands out of the noise",
        source="chosen: a log has a dozen harmonics",
    )
    patience: float = setting(
        1000.0,
        unit="1",
        meaning="periods of a sine after which a model that does not repeat itself never will",
        source="chosen: what dies away more slowly than that no bench waits for",
    )
    repeated: float = setting(
        5e-4,
        unit="1",
        meaning="share of a swing by which two periods differ that are the same",
        source="chosen: less than what a table tells",
    )
