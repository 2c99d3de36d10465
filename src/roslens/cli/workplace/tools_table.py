"""The table ``[tools]`` of a configuration: which foreign tools are used, and programs of the user's by name."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import Any

from roslens.model.errors import DocumentError
from roslens.model.source import Location
from roslens.source.settings import ToolCommand, ToolSettings
from roslens.source.tools.used import TOOLS, plain

_NAME = re.compile(r"[a-z][a-z0-9_]*\Z")
_KEYS = ("use", "layout", "time_limit_s", "imports")

Convert = Callable[[tuple[str, ...], object, Any], Any]
Where = Callable[[tuple[str, ...]], Location]


def read_tools(table: object, convert: Convert, where: Where) -> ToolSettings:
    """Return what the table says; a table inside it is a tool of the user's.

    Args:
        table: as the document has it.
        convert: turns the value of a key into a type, or raises what is wrong with it.
        where: returns the place of a key.

    Raises:
        DocumentError: a key or a value is not valid.
    """
    import msgspec

    if not isinstance(table, Mapping):
        raise DocumentError(f"tools = {table!r}", where=where(("tools",)), expected="a table [tools]")
    types = {field.name: field.type for field in msgspec.structs.fields(ToolSettings) if field.name in _KEYS}
    values: dict[str, Any] = {}
    commands: dict[str, ToolCommand] = {}
    for key, value in table.items():
        if key in types:
            values[key] = convert(("tools", key), value, types[key])
        elif isinstance(value, Mapping):
            commands[key] = _command(key, value, convert, where)
        else:
            raise DocumentError(
                f"unknown key 'tools.{key}'",
                where=where(("tools", key)),
                expected=f"one of {', '.join(types)}, or a table [tools.NAME] with a command",
            )
    return ToolSettings(**values, commands=commands)


def _command(name: str, table: Mapping[str, Any], convert: Convert, where: Where) -> ToolCommand:
    place = ("tools", name)
    if not _NAME.match(name):
        expected = "lower case letters, digits and _, a letter first"
        raise DocumentError(f"a tool is called {name!r}", where=where(place), expected=expected)
    if plain(name) in TOOLS:
        raise DocumentError(
            f"a table [tools.{name}]",
            where=where(place),
            expected="the name of a tool that roslens does not know",
            advice=f"Options of {name} belong in [options.{plain(name)}]",
        )
    for key in table:
        if key not in ("command", "reads"):
            raise DocumentError(
                f"unknown key 'tools.{name}.{key}'", where=where((*place, key)), expected="one of command, reads"
            )
    if "command" not in table:
        raise DocumentError(f"a table [tools.{name}] without command", where=where(place), expected="command = […]")
    words = convert((*place, "command"), table["command"], tuple[str, ...])
    if not words or not words[0]:
        raise DocumentError(
            f"tools.{name}.command = {list(words)!r}",
            where=where((*place, "command")),
            expected="the name of a program and its arguments",
        )
    reads = convert((*place, "reads"), table["reads"], tuple[str, ...]) if "reads" in table else ()
    return ToolCommand(words, reads)
