"""``--tools`` and ``--import``: what foreign tools have to say, beside what roslens finds itself."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.source.tools.used import NOT_RUN, TOOLS, plain

if TYPE_CHECKING:
    from roslens.model.result import RunHeader
    from roslens.source.settings import SourceSettings, ToolSettings


def add_tools_arguments(parser: argparse.ArgumentParser) -> None:
    """Add both options."""
    parser.add_argument(
        "--tools",
        action="append",
        metavar="NAME",
        help="also run external tools, instead of those in roslens.toml: for example cpplint,ruff; all: those "
        "that are installed; none: none (see `roslens plugins`)",
    )
    parser.add_argument(
        "--import",
        action="append",
        metavar="FILE",
        dest="imports",
        help="also take the findings of a SARIF file; may be given again",
    )


def with_tools(options: argparse.Namespace, settings: SourceSettings) -> SourceSettings:
    """Return the settings with the tools and SARIF files of the command line.

    ``options.each`` is there where findings about layout are wanted one by one: to mend them.
    """
    import msgspec

    tools = settings.tools
    if given := getattr(options, "tools", None):
        names = tuple(dict.fromkeys(name for one in given for name in one.split(",") if name))
        use = () if names == ("none",) else names
        commands = {name: command for name, command in tools.commands.items() if name in use or "all" in use}
        untrusted = tuple(name for name in tools.untrusted if name in use or "all" in use)
        tools = msgspec.structs.replace(tools, use=use, commands=commands, untrusted=untrusted, not_used=_kept(tools))
    if imports := getattr(options, "imports", None):
        # Those of the configuration start from its folder, these from the current one.
        here = tuple(str(Path(name).absolute()) for name in imports)
        tools = msgspec.structs.replace(tools, imports=(*tools.imports, *here))
    if getattr(options, "each", False):
        tools = msgspec.structs.replace(tools, layout="each")
    return msgspec.structs.replace(settings, tools=tools)


def tell_not_run(header: RunHeader) -> None:
    """Say on standard error which of all tools could not run."""
    for name, version in sorted(header.tools.items()):
        if version.startswith(NOT_RUN):
            why = version.removeprefix(NOT_RUN)
            print(f"roslens: {name} was not run, because {why}", file=sys.stderr)


def without_programs_of_models(tools: ToolSettings) -> ToolSettings:
    """Return the settings without the programs that models of the workspace would have started."""
    import msgspec

    not_used = tuple(name for name in tools.not_used if plain(name) in TOOLS)
    return msgspec.structs.replace(tools, not_used=not_used)


def _kept(tools: ToolSettings) -> tuple[str, ...]:
    """Return the programs that a model would have started: naming tools does not name these."""
    return tuple(name for name in tools.not_used if plain(name) not in TOOLS)
