"""Nuisances of sizes that no sensor has wait while a model is far off, and are allowed for again beside a near one."""

from pysim.diagnose.corrections import recounted
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.nuisance import OFFSET
from pysim.diagnose.refit import refit
from pysim.diagnose.settling import plausible, settle
from pysim.diagnose.story import Story, begin
from pysim.diagnose.subject import extended
from tests.pysim.diagnose.test_corrections import logged
from tests.pysim.diagnose.toy import toy_subject


def told(offset: float) -> tuple[Story, Fitted, Fitted]:
    """A story, the model as it is, and refitted with every nuisance allowed for."""
    story = begin(toy_subject(logged(5, offset=offset)), seed=0, workers=1, progress=None)
    what = extended(story.subject, ())
    first = story.allow(what, what.space.to_search(what.space.start))
    start = recounted(story.ruler, story.ruler.plain, Fitted(what, first))
    return story, start, Fitted(what, refit(story.ruler, what, first))


def kinds(story: Story) -> list[str]:
    return [suspect.kind for suspect in story.ruler.suspected]


def test_no_sensor_is_two_metres_off() -> None:
    story, start, soft = told(2.0)
    assert OFFSET in kinds(story)
    plain = plausible(story, soft, "base", start)
    assert OFFSET not in kinds(story)
    assert plain.point.cost > 2 * soft.point.cost  # the misfit shows
    settle(story, plain, "base")
    assert OFFSET not in kinds(story)  # as long as that is so


def test_allowed_for_again_beside_a_model_that_is_near() -> None:
    story, start, soft = told(0.0)
    assert plausible(story, soft, "base", start) is soft
    story.ruler = story.ruler.only([s for s in story.suspected if s.kind != OFFSET])
    settle(story, recounted(story.ruler.with_other(suspected=story.suspected), story.ruler, soft), "base")
    assert story.ruler.suspected == story.suspected
