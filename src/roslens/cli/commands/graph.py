"""``roslens graph``: the computation graph that launch files and code come to, read, not run."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from typing import TYPE_CHECKING

from roslens.cli.completion_words import ARGUMENTS, LAUNCHES
from roslens.cli.graph.graph_check import add_check_arguments
from roslens.cli.terminal.boundary import CLEAN, NOT_ANALYSED
from roslens.cli.terminal.streams import add_stream_arguments, write_result
from roslens.cli.workplace.reading_options import add_reading_arguments
from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.cli.graph.graph_source import GraphSource
    from roslens.model.configuration import Configuration

TEXT = "Show which node publishes, subscribes, serves and calls what, from source and launch files."
FORMATS = ("text", "json", "dot", "mermaid", "svg", "nodl", "params", "commands", "sros2", "rosgraph", "markdown")
_ONE = ("rosgraph", "sros2")
_WITH_IMPLICIT = ("sros2",)
_WITH_UNSTARTED = ("text", "json", "dot")
EXAMPLES = """\
  roslens graph                                    every node of the packages below this folder
  roslens graph --launch rover_bringup/rover.launch.py --arg navigation:=false
  roslens graph --package rover_base --node base_node --all
  roslens graph --launch rover_bringup/rover.launch.py --format svg -o rover.svg
  roslens graph --launch rover_bringup/rover.launch.py --html rover.html
  roslens graph --launch rover_bringup/rover.launch.py --format params -o rover_parameters.yaml
  roslens graph --launch rover_bringup/rover.launch.py --format commands
  roslens graph --launch rover_bringup/rover.launch.py --check --fail-on warning
  roslens graph --launch rover_bringup/rover.launch.py --diff origin/main HEAD --format markdown
  roslens graph --diff rover_bringup/rover.launch.py rover_bringup/rover.launch.py:navigation=false

exit codes: as everywhere; with --diff 1 where there is a difference"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of ``roslens graph``."""
    parser.add_argument("path", nargs="?", default=".", metavar="PATH", help="the workspace (default: this folder)")
    launch = parser.add_argument(
        "--launch", metavar="FILE", help="what it starts: PACKAGE/FILE, a path, or a name of [graph.configurations]"
    )
    argument = parser.add_argument(
        "--arg", action="append", default=[], metavar="NAME:=VALUE", help="argument of the launch file; may be repeated"
    )
    # Scripts of shells are made from what actions hold under this name.
    vars(launch)["complete"], vars(argument)["complete"] = LAUNCHES, ARGUMENTS
    parser.add_argument("--package", action="append", default=[], metavar="NAME", help="only what this package makes")
    parser.add_argument("--node", action="append", default=[], metavar="NAME", help="only this node, or a pattern")
    parser.add_argument("--all", action="store_true", help="include endpoints that every node has, such as /rosout")
    parser.add_argument("--format", choices=FORMATS, default="text", help="output format")
    parser.add_argument(
        "--diff",
        nargs=2,
        metavar=("A", "B"),
        help="compare two revisions of git (. is the files as they are), two launch files (FILE[:arg=value,...]) or "
        "two files written by --format json",
    )
    parser.add_argument("-o", "--output", metavar="FILE", help="write the result to this file instead")
    parser.add_argument("--html", metavar="FILE", help="draw it: one HTML file that needs nothing else")
    add_reading_arguments(parser)
    parser.add_argument("--no-store", action="store_true", help="as with check; graphs alone are never stored")
    add_check_arguments(parser)
    add_stream_arguments(parser)


def run(options: argparse.Namespace) -> int:
    """Assemble, print and return the exit code.

    Raises:
        RoslensError: see :mod:`roslens.cli.terminal.boundary`.
    """
    _refuse_contradictions(options)
    if options.diff:
        from roslens.cli.graph.graph_diff import diff

        return diff(options)
    from roslens.cli.graph.graph_choice import chosen, require_nodes
    from roslens.cli.graph.graph_linked import with_linked
    from roslens.cli.graph.graph_opened import open_source

    with open_source(options) as source:
        found = _configurations(source, options)
        unstarted = () if options.check else _unstarted(source, found, options)
        found = with_linked(found, unstarted, source.facts)
        for failure in source.facts.broken:
            print(f"roslens: {failure.what}; {failure.advice}", file=sys.stderr)
        if options.check:
            from roslens.cli.graph.graph_check import check

            _say_lacking(source, found, options)
            return check(source, found, options) or _complete(source, found)
        require_nodes(found, options.node)
        _say_given(source, found, options)
        if options.html or options.format == "svg":
            from roslens.cli.graph.graph_picture import draw

            draw(source, found, options, unstarted)
            return _complete(source, found)
        code = _complete(source, (*found, *unstarted))
        if not found:
            _say_why(source, options)
    listed = (*found, *unstarted) if options.format in _WITH_UNSTARTED and not options.node else found
    shown = tuple(chosen(one, options.node, implicit=options.all or options.format in _WITH_IMPLICIT) for one in listed)
    write_result(_text(shown, options), options.output)
    return code


def _refuse_contradictions(options: argparse.Namespace) -> None:
    if options.check and (options.diff or options.html):
        raise UsageError("--check with --diff or --html", expected="one of them")
    if options.fail_on and not options.check:
        raise UsageError("--fail-on without --check", expected="both")
    if options.html and (options.diff or options.output or options.format != "text"):
        raise UsageError("--html with --diff, --format or --output", expected="--html FILE alone")
    if not options.diff:
        _refuse_without_diff(options)


def _refuse_without_diff(options: argparse.Namespace) -> None:
    if options.format == "markdown":
        raise UsageError("--format markdown without --diff", expected="--diff A B too, or one of the other formats")
    if options.arg and not options.launch:
        raise UsageError("--arg without --launch", expected="the launch file whose argument it is")
    if options.launch and options.package:
        raise UsageError("--package with --launch", expected="one of them")


def _unstarted(
    source: GraphSource, found: tuple[Configuration, ...], options: argparse.Namespace
) -> tuple[Configuration, ...]:
    """Return what no known program starts: of the packages that are asked for, or that the launch file starts."""
    if options.launch:
        return source.unstarted_beside(found[0])
    return source.unstarted(options.package, () if options.package else found)


def _say_why(source: GraphSource, options: argparse.Namespace) -> None:
    from roslens.cli.graph.graph_without_nodes import reasons

    # Text says at least that there are no nodes; a document that others read does not.
    is_said = options.quiet and options.format == "text"
    for line in () if is_said else reasons(source, options.launch):
        print(f"roslens: {line}", file=sys.stderr)


def _say_given(source: GraphSource, found: tuple[Configuration, ...], options: argparse.Namespace) -> None:
    if options.quiet or not options.launch:
        return
    from roslens.cli.graph.graph_given import wrong_arguments
    from roslens.cli.graph.graph_source import arguments_of

    for line in wrong_arguments(found[0], source.meant(options.launch, arguments_of(options.arg))[1]):
        print(f"roslens: {line}", file=sys.stderr)


def _say_lacking(source: GraphSource, found: tuple[Configuration, ...], options: argparse.Namespace) -> None:
    """Report what a launch file needs that nothing is known to start: this is not a finding."""
    if not options.arg and options.launch not in source.settings.graph.configurations:
        _say_given(source, found, options)


def _complete(source: GraphSource, found: tuple[Configuration, ...]) -> int:
    """Return the exit code for whether there is a graph at all: an unreadable one is not a clean one."""
    return CLEAN if any(one.nodes for one in found) and not source.facts.broken else NOT_ANALYSED


def _configurations(source: GraphSource, options: argparse.Namespace) -> tuple[Configuration, ...]:
    from roslens.cli.graph.graph_source import arguments_of

    if options.launch:
        return (source.launched(options.launch, arguments_of(options.arg)),)
    return source.packages(options.package)


def _text(configurations: tuple[Configuration, ...], options: argparse.Namespace) -> str:
    if options.format == "json":
        from roslens.report.graph.graph_document import to_graph_json

        return to_graph_json(configurations)
    if not configurations:
        return "no nodes\n" if options.format == "text" else ""
    if options.format in _ONE and len(configurations) > 1:
        raise UsageError(
            f"--format {options.format} of packages of both generations",
            expected="one configuration",
            advice="Choose with --launch or --package",
        )
    if options.format == "dot":
        from roslens.report.graph.to_dot import to_dots

        return to_dots(configurations)
    writer = _writer(options.format)
    return "\n".join(writer(one) for one in configurations)


def _writer(form: str) -> Callable[[Configuration], str]:
    """Return what writes a configuration in a format."""
    if form == "rosgraph":
        from roslens.report.graph.to_rosgraph import to_rosgraph

        return lambda one: to_rosgraph(one.graph())
    from importlib import import_module

    module, name = _WRITERS[form]
    found: Callable[[Configuration], str] = getattr(import_module(f"roslens.report.graph.{module}"), name)
    return found


_WRITERS = {
    "text": ("configuration_text", "to_configuration_text"),
    "mermaid": ("to_mermaid", "to_mermaid"),
    "nodl": ("to_nodl", "to_nodl"),
    "params": ("to_parameters", "to_parameters"),
    "commands": ("to_commands", "to_commands"),
    "sros2": ("to_sros2", "to_sros2"),
}
