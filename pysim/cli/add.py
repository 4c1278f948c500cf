"""Add effects to a model, refit everything, and write the extended class with its FMU."""

from __future__ import annotations

import argparse


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The words behind `pysim add`."""
    from pysim.cli._subject import add_results, add_subject
    from pysim.cli.options import add_names

    add_subject(parser)
    add_names(parser, "--effects", what="to add, by their standard names, in order", required=True)
    add_results(parser, ", parameters.toml, the extended class and its FMU")


def run(args: argparse.Namespace) -> int:
    """Print what each effect does to the error, on fitted and held-out data; 0."""
    from pysim.cli._story import finish, unfold
    from pysim.cli._subject import effects_of, prepare_results, read_subject
    from pysim.cli.options import names_of
    from pysim.cli.progress import announce_compilation
    from pysim.diagnose import add
    from pysim.report.diagnosis import evidence_text
    from pysim.report.diagnosis_words import added_sentence

    prepare_results(args)
    given = read_subject(args)
    effects = effects_of(names_of(args.effects), given)
    announce_compilation()
    found = unfold(given, args, lambda story, journal: add(given.subject, effects, progress=story, journal=journal))
    print(added_sentence(found), evidence_text(found), sep="\n\n")
    finish(found, given, args, question="What do the effects mend?", answer=added_sentence(found))
    return 0
