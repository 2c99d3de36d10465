"""The foreign tools that roslens knows, by name."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache
from importlib import import_module

from roslens.model.errors import UsageError
from roslens.plugins.nearest import did_you_mean
from roslens.source.tools.tool import Tool
from roslens.source.tools.used import TOOLS, plain

ALL = "all"
"""Stands for every tool that is installed."""


@cache
def tool_named(name: str) -> Tool:
    """Return a tool by its name."""
    found: Tool = import_module(f"roslens.source.tools.{name}").plugin
    return found


def chosen_tools(use: Sequence[str], disable: Iterable[str] = (), further: Iterable[str] = ()) -> tuple[Tool, ...]:
    """Return the tools that are meant by names, in the order of :data:`~roslens.source.tools.used.TOOLS`.

    Args:
        use: names, ``all`` among them for every one.
        disable: names of those that are left out.
        further: names of tools that the user made known; they are valid, and not returned.

    Raises:
        UsageError: a name is unknown.
    """
    names = [plain(name) for name in use]
    known = (ALL, *TOOLS, *further)
    for given, name in zip(use, names, strict=True):
        if name not in known:
            raise UsageError(
                f"unknown tool {given!r}",
                expected=f"one of {', '.join(known)}",
                advice=did_you_mean(name, known) or "Whatever writes SARIF can be named in roslens.toml: [tools.NAME]",
            )
    off = {plain(name) for name in disable}
    tools = (tool_named(name) for name in TOOLS if name not in off)
    return tuple(tool for tool in tools if tool.name in names or (ALL in names and not tool.asks_the_net))
