"""``roslens reference``: documents that specify the expected behaviour of a running robot, and operations on them."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.cli.references import reference_draft, reference_export, reference_mutate, reference_test
from roslens.cli.terminal.boundary import BAD_INPUT, CLEAN, NOT_ANALYSED

if TYPE_CHECKING:
    from collections.abc import Sequence

    from roslens.judge.reference.explain_entity import Applied
    from roslens.judge.reference.merge_references import Merged
    from roslens.judge.reference.unmatched import Subject
    from roslens.model.entity import EntityId

TEXT = "Check, explain, draft, test, export or import references: documents that specify a robot's behaviour."
EXAMPLES = """\
  roslens reference check base.yaml site.yaml
  roslens reference check robot.yaml --bag drive.bag         and what of it is about nothing there
  roslens reference check robot.yaml --graph graph.yaml      and refuse actions on entities that are missing
  roslens reference explain base.yaml topic:/scan
  roslens reference explain base.yaml topic:/scan --bag drive.bag    and what was wrong with it there, and why
  roslens reference draft --bag drive.bag -o robot.yaml
  roslens reference draft --live 60s -o robot.yaml           from what runs here now
  roslens reference draft --graph graph.yaml                 presence alone, of a graph of `watch --graph-out`
  roslens reference test robot.yaml --bag drive.bag --expect alarms.yaml
  roslens reference test robot.yaml                         the time lines beside it
  roslens reference mutate robot.yaml --bag drive.bag        which faults it would see
  roslens reference export robot.yaml --grafana -o robot.json    or --prometheus, --alertmanager, --foxglove
  roslens reference import arni.yaml -o robot.yaml"""

_CHECK = "Check references, and list what they expect together."
_EXPLAIN = "Show what references expect of one entity, in which order, and where."
_IMPORT = "Convert a specification of ARNI into a reference, and report how each line was mapped."
_WIDEST = 72
"""Characters of a cell; `explain` shows all of them."""

_NARROWING = ("host", "type", "publisher", "subscriber")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the actions."""
    actions = parser.add_subparsers(title="actions", dest="action", metavar="ACTION", required=True)
    check = actions.add_parser("check", help=_CHECK, description=_CHECK)
    check.add_argument("files", nargs="+", metavar="FILE", help="references, later ones taking precedence")
    check.add_argument(
        "--bag", type=Path, nargs="+", metavar="FILE", help="report which of it matches nothing in a recording"
    )
    check.add_argument(
        "--graph",
        metavar="GRAPH",
        help="reject names that a graph does not have: of a run, `3:drive.launch.xml`, or of a file",
    )
    check.add_argument("-q", "--quiet", action="store_true", help="no table of expectations")
    check.set_defaults(act=_check)
    explain = actions.add_parser("explain", help=_EXPLAIN, description=_EXPLAIN)
    explain.add_argument("files", nargs="+", metavar="FILE", help="references, later ones taking precedence")
    explain.add_argument("entity", metavar="ENTITY", help="such as topic:/scan, node:/amcl or host:robot-1")
    for word in _NARROWING:
        explain.add_argument(f"--{word}", default="", metavar="NAME", help=f"its {word}, where that is known")
    explain.add_argument(
        "--bag", type=Path, nargs="+", metavar="FILE", help="also explain what was wrong with it in a recording"
    )
    explain.add_argument("--json", action="store_true", help="print JSON")
    explain.set_defaults(act=_explain)
    importing = actions.add_parser("import", help=_IMPORT, description=_IMPORT)
    importing.add_argument("file", metavar="FILE", help="the specification, in YAML")
    importing.add_argument(
        "-o", "--output", metavar="FILE", help="where to write the reference (default: standard output)"
    )
    importing.set_defaults(act=_import)
    for name, module in (
        ("draft", reference_draft),
        ("test", reference_test),
        ("mutate", reference_mutate),
        ("export", reference_export),
    ):
        module.add_arguments(
            actions.add_parser(
                name,
                help=module.TEXT,
                description=module.TEXT,
                epilog=f"examples:\n{module.EXAMPLES}",
                formatter_class=argparse.RawDescriptionHelpFormatter,
            )
        )


def run(options: argparse.Namespace) -> int:
    """Carry out the action and return the exit code.

    Raises:
        DocumentError: a document is wrong.
        UsageError: the entity is none.
    """
    return int(options.act(options))


def _check(options: argparse.Namespace) -> int:
    from roslens.cli.react.reference_reactions import reactions_table, types_not_checked
    from roslens.judge.reference.merge_references import constraints_of
    from roslens.judge.reference.wide_margin import wide_margins

    merged = _merged(options.files)
    for contradiction in merged.contradictions:
        print(f"roslens: {contradiction.error()}", file=sys.stderr)
    if not options.quiet:
        print(_table(merged))
        if reactions := reactions_table(merged.reference.reactions):
            print(reactions)
    for text in wide_margins(constraints_of(merged.reference)):
        print(f"roslens: {text}", file=sys.stderr)
    for text in types_not_checked(merged.reference.reactions):
        print(f"roslens: {text}", file=sys.stderr)
    for text in _about_nothing(merged, options) if options.bag or options.graph else ():
        print(f"roslens: {text}", file=sys.stderr)
    return BAD_INPUT if merged.contradictions else CLEAN


def _about_nothing(merged: Merged, options: argparse.Namespace) -> list[str]:
    from roslens.cli.react.reference_reactions import given_graph
    from roslens.cli.watch.about_nothing import RECORDED
    from roslens.judge.reference.unmatched import subjects_of, unmatched
    from roslens.judge.reference.unmatched_reactions import refuse_unknown_targets, unmatched_statements
    from roslens.live.adapters.bag.open_bag import open_bag
    from roslens.model.entity import EntityKind

    reference = merged.reference
    unmatched_texts: list[str] = []
    if options.graph:
        there = subjects_of(given_graph(options.graph))
        refuse_unknown_targets(reference.reactions, there)
        known = (EntityKind.NODE, EntityKind.TOPIC, EntityKind.CONNECTION, EntityKind.SERVICE)
        unmatched_texts += [str(one) for one in unmatched(reference, there, known)]
        unmatched_texts += unmatched_statements(reference.reactions, there, known)
    if options.bag:
        there = subjects_of(open_bag(options.bag).graph())
        unmatched_texts += [str(one) for one in unmatched(reference, there, RECORDED)]
        unmatched_texts += unmatched_statements(reference.reactions, there, RECORDED)
    return unmatched_texts


def _explain(options: argparse.Namespace) -> int:
    from roslens.cli.references.reference_causes import found_wrong, lines, rows
    from roslens.judge.reference.explain_entity import combined, explain_entity
    from roslens.live.window.signals import BY_KEY
    from roslens.model.entity import EntityId

    subject = _subject(options)
    merged = _merged(options.files)
    applied = explain_entity(merged, subject)
    entity = EntityId(subject.kind, subject.name)
    start, found = found_wrong(merged.reference, options.bag, entity) if options.bag else (0.0, [])
    if options.json:
        _print_explained(entity, applied, rows(start, found) if options.bag else None)
        return CLEAN
    print(f"{subject.kind.value}:{subject.name}")
    if not applied:
        print("  nothing is expected of it")
    for number, one in enumerate(applied, 1):
        print("\n".join(_explanation(number, one)))
    for key, words in combined(applied, BY_KEY).items():
        print(f"  together: {key} {words}")
    if options.bag:
        print("\n".join(["in the recording:", *(lines(start, found) or ["  nothing was wrong with it"])]))
    return CLEAN


def _print_explained(entity: EntityId, applied: Sequence[Applied], wrong: list[dict[str, object]] | None) -> None:
    import json

    from roslens.judge.reference.constraint_words import expected_words, subject_words

    constraints = [
        {
            "id": one.declared.constraint.details.id,
            "of": subject_words(one.declared.constraint),
            "expected": expected_words(one.declared.constraint),
            "where": one.declared.place,
            "severity": one.declared.constraint.details.severity.value,
            "provided": one.provided,
            "replaced_by": one.replaced_by,
        }
        for one in applied
    ]
    document: dict[str, object] = {"version": 1, "entity": str(entity), "constraints": constraints}
    if wrong is not None:
        document["wrong"] = wrong
    print(json.dumps(document, indent=2, ensure_ascii=False))


def _import(options: argparse.Namespace) -> int:
    from roslens.judge.arni.import_arni import Outcome, import_arni
    from roslens.live.window.signals import BY_KEY
    from roslens.model.errors import UsageError

    target = Path(options.output) if options.output else None
    if target is not None and target.exists():
        raise UsageError(f"{options.output!r} exists", expected="a new file", advice="Remove it, or choose another")
    text, entries = import_arni(Path(options.file), BY_KEY)
    if target is None:
        print(text, end="")
    else:
        target.write_text(text, "utf-8")
    for entry in entries:
        print(entry, file=sys.stderr)
    counts = ", ".join(f"{sum(one.outcome is outcome for one in entries)} {outcome.value}" for outcome in Outcome)
    print(f"roslens: {counts}", file=sys.stderr)
    return NOT_ANALYSED if any(one.outcome is Outcome.LEFT_OUT for one in entries) else CLEAN


def _merged(files: Sequence[str]) -> Merged:
    from roslens.judge.reading.read_reference import read_references
    from roslens.judge.reference.merge_references import merge_references
    from roslens.live.window.signals import BY_KEY

    return merge_references(read_references([Path(file) for file in files], BY_KEY))


def _table(merged: Merged) -> str:
    from roslens.judge.reference.constraint_words import expected_words, subject_words
    from roslens.judge.reference.merge_references import constraints_of

    def clipped(text: str) -> str:
        return text if len(text) <= _WIDEST else f"{text[: _WIDEST - 1]}…"

    heads = ("of", "is expected", "else", "id", "stands in")
    rows = [
        (
            clipped(subject_words(constraint)),
            clipped(expected_words(constraint)),
            constraint.details.severity.value,
            constraint.details.id,
            constraint.details.where,
        )
        for constraint in constraints_of(merged.reference)
    ]
    widths = [max(map(len, column)) for column in zip(heads, *rows, strict=True)]
    lines = [
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in (heads, *rows)
    ]
    documents = len(merged.reference.documents)
    total = (
        f"{len(rows)} constraint{'s' if len(rows) != 1 else ''} of {documents} document{'s' if documents != 1 else ''}"
    )
    return "\n".join([*(lines if rows else ()), total])


def _subject(options: argparse.Namespace) -> Subject:
    from roslens.judge.reference.reference_keys import KINDS
    from roslens.judge.reference.unmatched import Subject
    from roslens.model.entity import EntityKind
    from roslens.model.errors import UsageError
    from roslens.plugins.nearest import did_you_mean

    kind, _, name = options.entity.partition(":")
    words = [one.value for one in KINDS]
    if kind not in words or not name:
        expected = f"KIND:NAME with one of {', '.join(words)}"
        raise UsageError(f"{options.entity!r} is not an entity", expected=expected, advice=did_you_mean(kind, words))
    return Subject(EntityKind(kind), name, **{word: getattr(options, word) for word in _NARROWING})


def _explanation(number: int, applied: Applied) -> list[str]:
    from roslens.judge.ranges.amount import amount_text
    from roslens.judge.reference.constraint_words import expected_words, subject_words

    constraint = applied.declared.constraint
    details = constraint.details
    lasting = f", once it has lasted {amount_text(details.timing.lasting, 's')}" if details.timing.lasting else ""
    lines = [
        f"  {number}. {subject_words(constraint)}: {expected_words(constraint)}",
        f"     {details.id} in {details.where}; else {details.severity.value}{lasting}",
    ]
    lines += [f"     provided that {applied.provided}"] if applied.provided else []
    lines += [f"     {applied.role}"] if applied.role else []
    lines += [f"     does not hold any more: replaced in {applied.replaced_by}"] if applied.replaced_by else []
    return [*lines, f"     {details.text}"] if details.text else lines
