"""What rules on calls of classes of launch have in common: they judge one call after the other."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from tree_sitter import Node

from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.views.launch_code import LaunchCall, LaunchCode, launch_code

Judged = Iterable[tuple[Node, str]]
"""Places and messages."""


def each_call(
    rule: str, judge: Callable[[LaunchCall, LaunchCode], Judged]
) -> Callable[[Node, FileView], Iterator[Hit]]:
    """Return what a rule finds: whatever a function says of each call in a file.

    Args:
        rule: id.
        judge: says where a call is wrong, and why.
    """

    def found(_root: Node, view: FileView) -> Iterator[Hit]:
        code = launch_code(view)
        for call in code.calls if code is not None else ():
            for node, message in judge(call, code) if code is not None else ():
                yield view.hit(rule, node, message)

    return found
