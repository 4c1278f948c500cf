"""Say which physical effect a model lacks, from measurements."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pysim.cli._subject import Given


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The words behind `pysim diagnose`."""
    from pysim.cli._subject import add_effects, add_results, add_subject
    from pysim.cli.options import SEED

    add_subject(parser)
    add_effects(parser)
    parser.add_argument(
        "--max-effects", metavar="N", type=int, default=3, help="effects to add at most; 0 ranks them and adds none (3)"
    )
    parser.add_argument("--seed", metavar="S", type=int, default=0, help=SEED)
    add_results(parser, ", parameters.toml, the extended class and its FMU")


def run(args: argparse.Namespace) -> int:
    """Show the story as it unfolds; 0 with a verdict, whatever it is."""
    from pysim.cli._story import finish, unfold
    from pysim.cli._subject import prepare_results, read_subject
    from pysim.cli.options import names_of
    from pysim.cli.progress import announce_compilation
    from pysim.diagnose import diagnose
    from pysim.report.diagnosis import diagnosis_text
    from pysim.types import BadInput

    if args.max_effects < 0:
        raise BadInput(f"--max-effects {args.max_effects}: write how many effects may be added, 0 or more")
    prepare_results(args)
    given = read_subject(args, only=names_of(args.effects))
    announce_compilation()
    if not args.max_effects:
        return _rank(args, given)
    most = args.max_effects
    found = unfold(
        given,
        args,
        lambda story, journal: diagnose(given.subject, seed=args.seed, most=most, progress=story, journal=journal),
    )
    print(diagnosis_text(found))
    finish(found, given, args)
    return 0


def _rank(args: argparse.Namespace, given: Given) -> int:
    """Print what each candidate gains, screened or refitted; none is added."""
    from pysim.cli._story import finish, unfold
    from pysim.diagnose import rank
    from pysim.report.diagnosis import evidence_text
    from pysim.report.diagnosis_words import ranking_sentence

    found = unfold(
        given, args, lambda story, journal: rank(given.subject, seed=args.seed, progress=story, journal=journal)
    )
    print(ranking_sentence(found), evidence_text(found), sep="\n\n")
    finish(found, given, args, question="What would each effect gain?", answer=ranking_sentence(found))
    return 0
