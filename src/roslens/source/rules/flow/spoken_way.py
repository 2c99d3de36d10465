"""What a message calls the way from a callback to a function."""

from __future__ import annotations

from tree_sitter import Node

from roslens.source.rules.callbacks import function_name
from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.summary import Way


def spoken_way(way: Way, view: FileView) -> str:
    """Return where something happens: ``callback `Arm.tick` `` or `` `Arm.ask`, which callback … calls``."""
    first = _callback(way.functions[0], view)
    if way.is_direct:
        return first
    between = [f"`{function_name(one, view)}`" for one in way.functions[1:-1] if one.type != "lambda"]
    through = f" through {', '.join(between)}" if between else ""
    return f"`{function_name(way.functions[-1], view)}`, which {first} calls{through}"


def _callback(function: Node, view: FileView) -> str:
    if function.type == "lambda":
        return f"the callback in line {function.start_point[0] + 1}"
    return f"callback `{function_name(function, view)}`"
