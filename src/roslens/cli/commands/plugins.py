"""``roslens plugins``: what is there and what it gives."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.cli.terminal.boundary import CLEAN, NOT_ANALYSED
from roslens.cli.workplace.trust_option import add_trust_argument, admitted_by

if TYPE_CHECKING:
    from roslens.plugins.discovery import Discovered
    from roslens.plugins.member import Member

TEXT = "List plug-ins with the quantities and rules that each provides, and the foreign tools that --tools accepts."
EXAMPLES = """\
  roslens plugins
  roslens plugins --format json"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add where the configuration is and the format."""
    parser.add_argument("path", nargs="?", default=".", metavar="PATH", help="whose roslens.toml counts (default: .)")
    parser.add_argument("--config", metavar="FILE", help="configuration (default: the nearest roslens.toml)")
    add_trust_argument(parser)
    parser.add_argument("--format", choices=("text", "json"), default="text")


def run(options: argparse.Namespace) -> int:
    """Print the list; plug-ins that cannot be used are failures."""
    from roslens.cli.workplace.configuration import find_configuration
    from roslens.source.plugin_stage import discover_plugins

    root = str(Path(options.path).resolve())
    looked_at = Path(options.path).resolve()
    configuration = admitted_by(options, find_configuration(looked_at, options.config), looked_at)
    found = discover_plugins(configuration.source, Path(configuration.base or "."), configurations=True)
    if options.format == "json":
        print(_document(found, root))
    else:
        for member in found.members:
            for line in _lines(member):
                print(line)
        _print_tools(root)
    for item in found.unavailable:
        print(f"roslens: {item.plugin} rests until the program {item.program!r} is installed", file=sys.stderr)
    for failure in found.failures:
        print(f"roslens: {failure}", file=sys.stderr)
    return NOT_ANALYSED if found.failures else CLEAN


def _document(found: Discovered, root: str) -> str:
    import msgspec

    from roslens.cli.workplace.tools_found import found_tools

    document = {
        "plugins": [{"origin": member.origin, **msgspec.to_builtins(member.manifest)} for member in found.members],
        "tools": msgspec.to_builtins(list(found_tools(root, ask=False))),
        "failures": msgspec.to_builtins(found.failures),
    }
    return msgspec.json.format(msgspec.json.encode(document)).decode()


def _lines(member: Member) -> Iterator[str]:
    manifest = member.manifest
    yield f"{manifest.name} {manifest.version}  [{member.origin}]"
    yield f"  {manifest.text}"
    yield f"  scopes: {', '.join(manifest.scopes)}; languages: {', '.join(manifest.languages) or 'all'}"
    if manifest.needs:
        yield f"  needs: {', '.join(manifest.needs)}"
    for quantity in manifest.quantities:
        yield f"  quantity {quantity.key} [{quantity.unit}]: {quantity.title}"
    for rule in manifest.rules:
        yield f"  rule {rule.id} ({rule.severity.value}): {rule.title}"
    for option in manifest.options:
        yield f"  option {option.name} ({option.type}, default {option.default!r}): {option.text}"


def _print_tools(root: str) -> None:
    """List the foreign tools: those that are there, and how to get the others."""
    from roslens.cli.workplace.tools_found import found_tools

    print("\nForeign tools, for `roslens check --tools NAME`:")
    for tool in found_tools(root, ask=False):
        print(f"  {tool.name}  [{tool.path or 'not installed'}]")
        print(f"    {tool.text}")
        if not tool.path:
            print(f"    get it: {tool.get}")
