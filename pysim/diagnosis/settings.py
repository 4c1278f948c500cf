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
    beam: int = setting(
        2, unit="1", meaning="first steps that are gone on with", source="measured: known-answers, only-together"
    )
    small: float = setting(
        0.02, unit="1", meaning="share of what can be gained below which steps on trial are not worth it",
        source="Mallows 1973, Technometrics 15:661: less does not pay for its parameters",
    )  # fmt: skip
    not_in_catalogue: float = setting(
        0.1, unit="1", meaning="share of the avoidable sum of squares below which effects do not explain the data",
        source="measured: known-answers, unknown",
    )  # fmt: skip
    near: float = setting(
        1.5, unit="1", meaning="levels over their white floor below which first-order gains put candidates aside",
        source="measured: there they err by 2 at most",
    )  # fmt: skip
    first_order_error: float = setting(
        4.0, unit="1", meaning="factor by which a first-order gain may be too small near the floor",
        source="measured: twice the largest seen",
    )  # fmt: skip
    finalists: int = setting(
        3, unit="1", meaning="candidates of a step that are refitted to the end", source="measured: known-answers"
    )
    heat: int = setting(
        3, unit="1", meaning="points that a refit is given before the candidates are compared",
        source="measured: steps to within a tenth of the gain",
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
    rougher: float = setting(
        30.0, unit="1", meaning="tolerance of candidates' runs over that of what is kept, once that was refined",
        source="as between a fit's rough and fine search",
    )  # fmt: skip
    refinements: int = setting(3, unit="1", meaning="tenfold refinements at most", source="to 1e-8, near rounding")
    unexplained: float = setting(
        0.5, unit="1", meaning="residual over the signal's standard deviation from which on no model is complete",
        source="half of fit percent: less is no description of the plant",
    )  # fmt: skip
    follows_t: float = setting(
        3.0, unit="1", meaning="standard deviations from which on a residual follows the model's own signals",
        source="a chance of 0.1 %",
    )  # fmt: skip
    max_effects: int = setting(
        4, unit="1", meaning="effects in a model at most", source="more have no name to a reader"
    )
    seed: int = setting(0, unit="1", meaning="of every draw", source="convention")
