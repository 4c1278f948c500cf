"""Rank the effects of the catalogue by what they gain on measurements, without deciding."""

from __future__ import annotations

import argparse


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The words behind `pysim rank`."""
    from pysim.cli._options import SEED
    from pysim.cli._subject import add_effects, add_results, add_subject

    add_subject(parser)
    add_effects(parser)
    parser.add_argument("--seed", metavar="S", type=int, default=0, help=SEED)
    add_results(parser, ", parameters.toml")


def run(args: argparse.Namespace) -> int:
    """Print what each candidate gains, screened or refitted; 0."""
    from pysim.cli._progress import announce_compilation
    from pysim.cli._story import finish, unfold
    from pysim.cli._subject import prepare_results, read_subject
    from pysim.diagnose import rank
    from pysim.report.diagnosis import evidence_text
    from pysim.report.diagnosis_words import ranking_sentence

    prepare_results(args)
    given = read_subject(args)
    announce_compilation()
    found = unfold(
        given, args, lambda story, journal: rank(given.subject, seed=args.seed, progress=story, journal=journal)
    )
    print(ranking_sentence(found), evidence_text(found), sep="\n\n")
    finish(found, given, args, question="What would each effect gain?", answer=ranking_sentence(found))
    return 0
