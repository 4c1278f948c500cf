"""Say which physical effect a model lacks, from measurements."""

from __future__ import annotations

import argparse


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The words behind `pysim diagnose`."""
    from pysim.cli._options import SEED
    from pysim.cli._subject import add_effects, add_results, add_subject

    add_subject(parser)
    add_effects(parser)
    parser.add_argument("--most", metavar="N", type=int, default=3, help="effects to add at most (3)")
    parser.add_argument("--seed", metavar="S", type=int, default=0, help=SEED)
    add_results(parser, ", parameters.toml, the extended class and its FMU")


def run(args: argparse.Namespace) -> int:
    """Show the story as it unfolds; 0 with a verdict, whatever it is."""
    from pysim.cli._progress import announce_compilation
    from pysim.cli._story import finish, unfold
    from pysim.cli._subject import prepare_results, read_subject
    from pysim.diagnose import diagnose
    from pysim.report.diagnosis import diagnosis_text

    prepare_results(args)
    given = read_subject(args)
    announce_compilation()
    found = unfold(
        given,
        args,
        lambda story, journal: diagnose(given.subject, seed=args.seed, most=args.most, progress=story, journal=journal),
    )
    print(diagnosis_text(found))
    finish(found, given, args)
    return 0
