"""``--fix``, ``--diff`` and ``--undo-fix`` of ``roslens check``."""

from __future__ import annotations

import argparse

from roslens.model.errors import UsageError


def add_fix_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options about fixes."""
    parser.add_argument(
        "--fix",
        action="store_true",
        help="fix in place what can be fixed safely, then report the rest; --undo-fix reverts it",
    )
    parser.add_argument(
        "--diff",
        action="store_true",
        help="show what --fix would change as a diff, and change nothing; exit with 1 where it would change something",
    )
    parser.add_argument(
        "--fix-rule",
        action="append",
        metavar="RULE",
        help="with --fix or --diff, fix findings of these rules only; ids or patterns such as 'cpp.*'; may be given "
        "again",
    )
    parser.add_argument(
        "--undo-fix", action="store_true", help="revert what the last --fix changed, and do nothing else"
    )


def refuse_contradictions(options: argparse.Namespace) -> None:
    """Refuse options about fixes that contradict each other.

    Raises:
        UsageError: they do.
    """
    given = [name for name in ("fix", "diff", "undo_fix", "watch") if getattr(options, name, False)]
    if len(given) > 1:
        names = [f"--{name.replace('_', '-')}" for name in given]
        raise UsageError(f"{names[0]} with {names[1]}", expected="one of them")
    if options.fix_rule and not (options.fix or options.diff):
        raise UsageError("--fix-rule without --fix or --diff", expected="one of them")
    if options.diff and (options.output or options.format):
        raise UsageError(
            "--diff with --format or -o",
            expected="--diff alone: it writes a diff",
            advice="roslens check --diff > FILE",
        )
