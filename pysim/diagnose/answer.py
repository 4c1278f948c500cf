"""The verdict, and the whole answer put together."""

from __future__ import annotations

from pysim.diagnose import decide
from pysim.diagnose.corrections import Settled
from pysim.diagnose.doubt import doubt, held_still
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.null import leftover
from pysim.diagnose.story import Story
from pysim.types.diagnosis import NONE, UNKNOWN, AddedEffect, Diagnosis, Missing, NextTest


def answered(
    story: Story,
    final: Fitted,
    verdict: str,
    reason: str,
    missing: tuple[Missing, ...] = (),
    test: NextTest | None = None,
) -> Diagnosis:
    """Everything that was found.

    Args:
        final: the model at the end of the story.
        verdict, reason: what `decided` says.
        missing: terms at its places, where they were looked for.
        test: that would separate what is tied.
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
        next_test=test,
        stages=tuple(story.stages),
    )


def decided(story: Story, base: Settled, final: Settled, *, why_none: str = "") -> tuple[str, str]:
    """Verdict and reason: what was added is named only where nothing else is left.

    Args:
        why_none: why no effect was added, where that was no matter of what effects gain.
    """
    point, names = final.at.point, [e.name for e in final.at.what.effects]
    ruler = final.lean
    freedom = ruler.freedom - point.x.size
    rest = leftover(ruler, point, seed=story.seed)
    share = decide.explained(base.at.point.cost - point.cost, base.at.point.cost, freedom)
    level = point.cost / max(freedom, 1)
    as_noise = rest.p_value >= decide.SURE and level < decide.LEVEL
    complete = as_noise or (bool(names) and share >= decide.WHOLE)
    left = f"{level:.3g} times the noise's variance is left"
    if not names and complete:
        return NONE, f"the refitted base model explains the data: {left}, and nothing in it has a pattern"
    where = f", most of it {rest.where[0]}" if rest.where else ""
    if not names and why_none:
        return UNKNOWN, f"{left}{where}; {why_none}"
    if not names and story.subject.build_variant is None:
        return UNKNOWN, f"{left}{where}, and no effect could be tried"
    if not names and not story.subject.catalogue:
        return UNKNOWN, f"{left}{where}, and the catalogue has no effect for this model"
    if not names:
        return UNKNOWN, f"{left}{where}, and {story.refused or 'no effect takes a fair share of it'}"
    both, plural = " and ".join(names), len(names) > 1
    if complete:
        return names[
            0
        ], f"{both} {'explain' if plural else 'explains'} {100 * share:.1f} % of what the base model leaves"
    return UNKNOWN, f"{both} {'help' if plural else 'helps'}, but {left}{where}; something else is missing"
