"""A round of the search begins: every effect that the model so far lacks, and what each promises."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from pysim.diagnose import decide
from pysim.diagnose.blame import Blame
from pysim.diagnose.contenders import Contender
from pysim.diagnose.corrections import evidence, is_off, recounted
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.nuisance import Suspect
from pysim.diagnose.null import chance
from pysim.diagnose.residuals import Ruler
from pysim.diagnose.screen import Footprint, across, column_space, footprint, per_effect, screen
from pysim.diagnose.story import Story
from pysim.types import BadInput

# Mean square residual from which the parameters of the model so far count as bent.
_BENT = 2.0


@dataclass(frozen=True)
class Tried:
    """What a round tried.

    Args:
        current: the model so far.
        ruler: that counts it.
        contenders: by the name of the effect, each with the ruler that allows for the nuisances it leaves to blame.
        footprints: of all, the best gain first; every nuisance is allowed for.
        instead: by the name of the effect, by how much it is more likely, with the nuisances that it leaves to blame,
            than those that are to blame without it.
        limit: gain that chance alone exceeds seldom.
        left: sum of squares that the model so far leaves beside the nuisances that are to blame without any effect.
    """

    current: Fitted
    ruler: Ruler
    contenders: dict[str, Contender]
    footprints: tuple[Footprint, ...]
    instead: dict[str, float]
    limit: float
    left: float

    @property
    def bent(self) -> bool:
        """Whether so much is left that the parameters have left their place to make up for it."""
        return self.left > _BENT * self.current.point.residual.size

    @property
    def promises(self) -> bool:
        """Whether some effect promises more than chance does, or straight lines are not to be trusted."""
        return self.bent or any(self.worth(head) >= self.limit for head in self.heads)

    @property
    def heads(self) -> list[Footprint]:
        """The best footprint of each effect, the most promising effect first."""
        return sorted(per_effect(self.footprints), key=lambda head: -self.worth(head))

    def beside(self, one: Contender) -> tuple[Fitted, list[Footprint]]:
        """The model so far as a contender's ruler counts it, and the contender's footprints there, the best first."""
        current, own = recounted(self.ruler, one.ruler, self.current), list[Footprint]()
        span = column_space(current.point.jacobian)
        left_over = across(span, current.point.residual)
        for f in self.footprints:
            if f.effect.name == one.effect.name:
                change = one.ruler.span.across(f.plain[:, None])[:, 0]
                own += footprint(f.effect, f.values, change, span, left_over)
        return current, sorted(own, key=lambda f: -f.gain)

    def worth(self, head: Footprint) -> float:
        """What an effect promises: what it explains itself, or what it explains in place of nuisances."""
        return max(head.gain, self.instead.get(head.effect.name, 0.0))


def screened(story: Story, current: Fitted) -> Tried:
    """Every effect of the catalogue that the model so far lacks, in a run or two."""
    missing = [e for e in story.subject.catalogue if e.name not in [had.name for had in current.what.effects]]
    story.now(f"compiling {len(missing)} candidates")
    contenders = {}
    for effect in missing:
        try:
            contenders[effect.name] = story.extended(current, effect)
        except BadInput as error:
            story.note(f"{effect.name} could not be tried: {error}")
    story.stage("build")
    story.now(f"screening {len(contenders)} candidates")
    footprints = screen(current, list(contenders.values()))
    limit = chance(footprints, scale=1.0, seed=story.seed).limit
    ruler = story.ruler_of(current.what)
    none = story.blame(current)
    left_to = {} if is_off(ruler, current.point) else _left_to(ruler, current, footprints)
    for name, blame in left_to.items():
        one = contenders[name]
        contenders[name] = replace(one, ruler=one.ruler.only(blame.suspects))
    note_mimics(story, none, left_to)
    instead = {name: blame.over(none) for name, blame in left_to.items()}
    tried = Tried(current, ruler, contenders, footprints, instead, limit, none.cost)
    story.stage("screen")
    heads = ", ".join(f"{f.effect.name} {tried.worth(f):.4g}" for f in tried.heads[:3])
    story.say(f"screened {len(contenders)} effects: {heads}; by chance up to {limit:.3g}")
    return tried


def _left_to(ruler: Ruler, current: Fitted, footprints: Sequence[Footprint]) -> dict[str, Blame]:
    """By the name of the effect the nuisances that it leaves to blame."""
    found = evidence(ruler, current.point, [f.plain for f in footprints])
    best = dict[str, Blame]()
    for f, blame in zip(footprints, found.beside([f.signed for f in footprints]), strict=True):
        if f.effect.name not in best or blame.total < best[f.effect.name].total:
            best[f.effect.name] = blame
    return best


def note_mimics(story: Story, none: Blame, left_to: Mapping[str, Blame]) -> None:
    """Tells which effects would do what one nuisance does."""
    mimics: dict[Suspect, list[str]] = {}
    for name, blame in left_to.items():
        spared = none.suspects - blame.suspects
        if len(spared) == 1 and abs(blame.over(none)) < decide.TIE:
            mimics.setdefault(next(iter(spared)), []).append(name)
    for suspect, names in mimics.items():
        of = f"the {suspect.kind} of {suspect.signal}" if suspect.signal else "the shift of clocks"
        story.note(f"{' or '.join(sorted(names))} would do what {of} does: these data cannot tell them apart")


def promise(tried: Tried, at: Fitted) -> float:
    """The best gain of what was tried, were it asked again at another model: footprints hardly change, slopes do."""
    names = [effect.name for effect in at.what.effects]
    span = column_space(at.point.jacobian)
    left_over = across(span, at.point.residual)
    again = (
        found.gain
        for old in tried.footprints
        if old.effect.name not in names
        for found in footprint(old.effect, old.values, old.change, span, left_over)
    )
    return max(again, default=0.0)
