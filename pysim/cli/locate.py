"""Estimate what is missing at each place of a model, and its shape, without naming an effect."""

from __future__ import annotations

import argparse


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The words behind `pysim locate`."""
    from pysim.cli._subject import add_results, add_subject
    from pysim.cli.options import add_names

    add_subject(parser)
    add_names(parser, "--with", what="effects that the model is to have already")
    add_results(parser, ", parameters.toml")


def run(args: argparse.Namespace) -> int:
    """Print the places with the term that each would need; 0."""
    from pysim.cli._story import finish, unfold
    from pysim.cli._subject import effects_of, prepare_results, read_subject
    from pysim.cli.options import names_of
    from pysim.cli.progress import announce_compilation
    from pysim.diagnose import located
    from pysim.report.diagnosis import evidence_text
    from pysim.report.diagnosis_words import missing_sentence

    prepare_results(args)
    given = read_subject(args)
    there = names_of(getattr(args, "with"))  # a word of Python
    effects = effects_of(there, given, "--with") if there else ()
    announce_compilation()
    found = unfold(given, args, lambda story, journal: located(given.subject, effects, progress=story, journal=journal))
    print(missing_sentence(found), evidence_text(found), sep="\n\n")
    finish(found, given, args, question="Where is what missing?", answer=missing_sentence(found))
    return 0
