"""``roslens port``: what breaks in a workspace between two distributions of ROS, and the mechanical part of it made."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from roslens.cli.terminal.streams import add_stream_arguments

if TYPE_CHECKING:
    from pathlib import Path

    from roslens.cli.workplace.configuration import Configuration
    from roslens.model.distributions.port import Port
    from roslens.source.port.ported import Ported
    from roslens.source.settings import SourceSettings

TEXT = "Tell what breaks in a workspace between two distributions of ROS, and change what can be changed mechanically."
EXAMPLES = """\
  roslens port humble jazzy                       what breaks, by consequence, in the packages below this folder
  roslens port humble lyrical ~/robot_ws/src
  roslens port humble lyrical --diff              the mechanical part as a diff; nothing is changed
  roslens port humble lyrical --fix               the mechanical part made; --undo-fix takes it back
  roslens port humble lyrical --format markdown -o port.md     a list to work through
  roslens port humble jazzy --format json | jq '.breaks[].path'

exit codes: as everywhere; 1 where something breaks"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the distributions, and how the result is written."""
    parser.add_argument("before", metavar="FROM", help="the distribution that the packages are for")
    parser.add_argument("after", metavar="TO", help="the distribution that they are to be for")
    parser.add_argument("paths", nargs="*", default=["."], metavar="PATH", help="folders to look into (default: .)")
    parser.add_argument(
        "--diff", action="store_true", help="show what can be changed mechanically as a diff, and change nothing"
    )
    parser.add_argument("--fix", action="store_true", help="change it in place, then report the rest")
    parser.add_argument("--undo-fix", action="store_true", help="revert what the last --fix changed, nothing else")
    parser.add_argument("--format", choices=("text", "markdown", "json"), default="text")
    parser.add_argument("-o", "--output", metavar="FILE", help="write to this file instead of standard output")
    parser.add_argument("--config", metavar="FILE", help="configuration (default: the nearest roslens.toml)")
    parser.add_argument("--no-cache", action="store_true", help="read every file again, and keep nothing")
    add_stream_arguments(parser)


def run(options: argparse.Namespace) -> int:
    """Write what breaks, or change what can be, and return the exit code.

    Raises:
        RoslensError: see :mod:`roslens.cli.terminal.boundary`.
    """
    from pathlib import Path

    from roslens.cli.check.check_fix import take_back
    from roslens.cli.workplace.configuration import find_configuration
    from roslens.cli.workplace.workplace import CACHE, own_folder
    from roslens.source.workspace.find import root_of
    from roslens.store.cache import Cache

    _refuse(options)
    root = root_of(options.paths)
    if options.undo_fix:
        return take_back(options, root)
    configuration = find_configuration(root, options.config)
    settings = _settings(configuration)
    kept = None if options.no_cache else own_folder(root) / CACHE
    with Cache.open(kept) as cache:

        def look() -> Ported:
            from roslens.source.port.ported import ported

            between = (options.before, options.after)
            return ported(options.paths, settings, between, Path(configuration.base or "."), cache)

        found = look()
        if options.diff:
            return _show(options, root, settings, found)
        if options.fix and _fix(options, root, settings, found):
            found = look()
    return _report(options, found)


def _settings(configuration: Configuration) -> SourceSettings:
    import os

    import msgspec

    from roslens.source.workspace.conditions import environment_of

    settings = configuration.source
    seen = {**environment_of(os.environ), **settings.workspace.environment}
    return msgspec.structs.replace(settings, workspace=msgspec.structs.replace(settings.workspace, environment=seen))


def _refuse(options: argparse.Namespace) -> None:
    from roslens.model.errors import UsageError
    from roslens.plugins.nearest import did_you_mean
    from roslens.source.distributions.known_distributions import distributions, is_at_least

    known = distributions()
    for name in (options.before, options.after):
        if name not in known:
            raise UsageError(f"{name!r}", expected=f"one of {', '.join(known)}", advice=did_you_mean(name, known))
    if options.before == options.after or not is_at_least(options.after, options.before):
        raise UsageError(
            f"from {options.before} to {options.after}",
            expected="a later distribution of the same version of ROS as the second one",
            advice=f"roslens check --distro {options.after}",
        )
    given = [name for name in ("fix", "diff", "undo_fix") if getattr(options, name)]
    if len(given) > 1:
        names = [f"--{name.replace('_', '-')}" for name in given]
        raise UsageError(f"{names[0]} with {names[1]}", expected="one of them")
    if options.diff and (options.output or options.format != "text"):
        raise UsageError("--diff with --format or -o", expected="--diff alone: it writes a diff")


def _show(options: argparse.Namespace, root: Path, settings: SourceSettings, found: Ported) -> int:
    from roslens.cli.check.check_fix import tell, write_diff
    from roslens.cli.check.fixing import summary
    from roslens.cli.terminal.boundary import CLEAN, FINDINGS, NOT_ANALYSED
    from roslens.source.port.ported import mended_port

    result = mended_port(found, settings)
    write_diff(result.files, root)
    failures = (*found.failures, *result.failures)
    tell(options, summary([result], would=True), failures)
    if failures:
        return NOT_ANALYSED
    return FINDINGS if result.files else CLEAN


def _fix(options: argparse.Namespace, root: Path, settings: SourceSettings, found: Ported) -> bool:
    """Write what can be changed; return whether anything was."""
    import sys

    from roslens.cli.check.check_fix import tell
    from roslens.cli.check.fixing import summary, written
    from roslens.source.port.ported import mended_port

    result, _ = written(mended_port(found, settings), root, keep=True)
    tell(options, summary([result]), result.failures)
    if result.files and not options.quiet:
        print("roslens: `git diff` shows what changed; --undo-fix takes it back", file=sys.stderr)
    return bool(result.files)


def _report(options: argparse.Namespace, found: Ported) -> int:
    from roslens.cli.check.check_fix import tell
    from roslens.cli.terminal.boundary import CLEAN, FINDINGS, NOT_ANALYSED
    from roslens.cli.terminal.streams import write_result

    write_result(_written(found.port, options.format), options.output)
    if found.failures:
        tell(options, f"{len(found.failures)} could not be analysed", found.failures)
        return NOT_ANALYSED
    return FINDINGS if found.port.breaks or found.port.already else CLEAN


def _written(port: Port, form: str) -> str:
    from roslens.report.run.port_text import port_document, port_lines, port_markdown

    if form == "json":
        import msgspec

        return msgspec.json.format(msgspec.json.encode(port_document(port)), indent=1).decode() + "\n"
    if form == "markdown":
        return port_markdown(port)
    return "".join(f"{line}\n" for line in port_lines(port))
