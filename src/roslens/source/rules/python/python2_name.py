"""Rule ``python.python2_name``: names and methods that Python 3 does not have."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import is_handled
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_METHODS = frozenset({"has_key", "iteritems", "iterkeys", "itervalues"})
_INSTEAD = {
    "xrange": "range", "raw_input": "input", "unicode": "str", "basestring": "str", "unichr": "chr", "has_key": "in",
    "iteritems": "items", "iterkeys": "keys", "itervalues": "values", "execfile": "exec(open(…).read())",
}  # fmt: skip
_BOTH = re.compile(
    rb"\bsix\b|version_info|python_version|NameError|PY[23]\b|\bpast\b|AttributeError|hasattr|hexversion|sys\.version"
)


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield the first use of each name that only Python 2 has, in a file that knows nothing of Python 3."""
    name = view.text(node)
    if name not in _INSTEAD or node.type != "identifier" or node.parent is None or _BOTH.search(view.code):
        return
    # `try: raw_input() except: input()` is for both.
    if is_handled(node):
        return
    call = node.parent
    if name in _METHODS:
        is_used = call.type == "attribute" and call.parent is not None and call.parent.type == "call"
        is_used = is_used and call.child_by_field_name("attribute") == node
    else:
        is_used = call.type in ("call", "argument_list", "tuple") and not _is_keyword(node)
    word = name.encode()
    if not is_used or re.search(rb"(?:def|import|as)\s+%b\b|\b%b\s*=[^=]" % (word, word), view.code):
        return
    if re.search(rb"\b%b\b" % word, view.code[: node.start_byte]) is None:
        message = f"{name!r} exists in Python 2 only; expected {_INSTEAD[name]!r}"
        is_sure = name != "has_key" or _is_dictionary(call.child_by_field_name("object"), view)
        yield view.hit("python.python2_name", node, message, certainty=None if is_sure else Certainty.HEURISTIC)


def _is_dictionary(owner: Node | None, view: FileView) -> bool:
    """Tell whether the file makes a dictionary of that name: other classes may have such a method."""
    name = re.escape(view.text(owner).encode())
    return re.search(rb"(?<![\w.])%s\s*(?::[^=\n]+)?=\s*(?:\{|dict\()" % name, view.code) is not None


def _is_keyword(node: Node) -> bool:
    return node.parent is not None and node.parent.type == "keyword_argument"


RULE = FileRule(
    id="python.python2_name",
    title="Name of Python 2",
    finds="`xrange`, `raw_input`, `unicode`, `basestring`, `unichr`, `execfile`, `.has_key()`, `.iteritems()` and "
    "their kind, in a file that has nothing for Python 3 (no `six`, `version_info`, `NameError`). The first use of "
    "each is reported; `.has_key()` of what the file does not make as a dictionary is a note.",
    why="It raises a NameError or AttributeError when the line is reached, which may be in a callback after an "
    "hour of driving.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=(),
    syntax="python",
    anchors=(
        "xrange",
        "raw_input",
        "unicode",
        "basestring",
        "unichr",
        "has_key",
        "iteritems",
        "iterkeys",
        "itervalues",
        "execfile",
    ),
    clauses=("ruff F821", "pylint E0602"),
    bad="for i in xrange(10):\n    step(i)",
    good="for i in range(10):\n    step(i)",
    found=found,
)
