"""The verdict, and the whole answer put together."""

from __future__ import annotations

from pysim.diagnose import decide
from pysim.diagnose.doubt import doubt, held_still
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.story import Story
from pysim.types.diagnosis import NONE, UNKNOWN, AddedEffect, Diagnosis, Missing


def answered(story: Story, final: Fitted, verdict: str, reason: str, missing: tuple[Missing, ...] = ()) -> Diagnosis:
    """Everything that was found.

    Args:
        final: the model at the end of the story.
        verdict, reason: what `decided` says.
        missing: terms at its places, where they were looked for.
    """
    for line in story.disturbed():
        story.note(line)
    what, found = final.what, doubt(story.subject, final)
    relative, held = held_still(story.subject, final)
    if what.effects:
        for direction in held:
            name = next(iter(direction.exponents))
            story.note(f"intervals of the effects hold {name}, which these data do not determine by itself")
    estimates = {e.name: e for e in relative}
    added = tuple(
        AddedEffect(e, what.places[e.name], tuple(estimates[f"{what.places[e.name]}.{p.name}"] for p in e.parameters))
        for e in what.effects
    )
    story.stage("intervals")
    story.say(f"verdict: {verdict}. {reason}")
    where = next((stage.where for stage in reversed(story.stages) if stage.step in ("prior", "refit")), ())
    return Diagnosis(
        verdict,
        reason,
        added,
        tuple(story.ranking),
        tuple(story.ties),
        tuple(story.ledger),
        found.estimates,
        where,
        story.seconds,
        tuple(story.notes),
        missing=missing,
        stages=tuple(story.stages),
    )


def decided(story: Story, base: Fitted, final: Fitted) -> tuple[str, str]:
    """Verdict and reason."""
    point, names = final.point, [e.name for e in final.what.effects]
    freedom = point.residual.size - point.x.size
    left = point.cost / max(freedom, 1)
    share = decide.explained(base.point.cost - point.cost, base.point.cost, freedom)
    complete = left < decide.COMPLETE or (names and share >= decide.WHOLE)
    if not names and complete:
        return NONE, f"the refitted base model explains the data to {left:.3f} times the noise's variance"
    if not names and story.subject.build_variant is None:
        return UNKNOWN, f"{left:.3g} times the noise's variance is left, and no effect could be tried"
    if not names and not story.subject.catalogue:
        return UNKNOWN, f"{left:.3g} times the noise's variance is left, and the catalogue has no effect for this model"
    if not names:
        return UNKNOWN, f"{left:.3g} times the noise's variance is left, and no effect takes a fair share of it"
    both = " and ".join(names)
    if complete:
        verb = "explains" if len(names) == 1 else "explain"
        return names[0], f"{both} {verb} {100 * share:.1f} % of what the base model leaves over noise"
    rest = f"{left:.3g} times the noise's variance is left; something else is missing"
    return UNKNOWN, f"{both} {'helps' if len(names) == 1 else 'help'}, but {rest}"
