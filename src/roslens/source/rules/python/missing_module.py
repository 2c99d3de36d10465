"""Rule ``python.missing_module``: an import of a module that Python no longer has."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_GONE = {
    "urllib2": "urllib.request", "urlparse": "urllib.parse", "ConfigParser": "configparser", "Queue": "queue",
    "cPickle": "pickle", "StringIO": "io.StringIO", "cStringIO": "io.StringIO", "Tkinter": "tkinter",
    "tkMessageBox": "tkinter.messagebox", "tkFileDialog": "tkinter.filedialog", "httplib": "http.client",
    "commands": "subprocess", "thread": "threading", "__builtin__": "builtins", "SocketServer": "socketserver",
    "BaseHTTPServer": "http.server", "SimpleHTTPServer": "http.server", "xmlrpclib": "xmlrpc.client",
    "HTMLParser": "html.parser", "Cookie": "http.cookies", "cookielib": "http.cookiejar", "exceptions": "builtins",
}  # fmt: skip
_AROUND = ("try_statement", "if_statement", "with_statement")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield an import of a module that Python 3 does not have, where nothing catches it."""
    if above(node, *_AROUND) is not None:
        return
    field = "module_name" if node.type == "import_from_statement" else "name"
    modules = node.children_by_field_name(field)
    for module in modules:
        if module.type == "relative_import":
            continue
        written = module.child_by_field_name("name") if module.type == "aliased_import" else module
        name = view.text(written)
        if name in _GONE:
            message = f"module {name!r} exists in Python 2 only; expected {_GONE[name]!r}"
            inside = above(node, "function_definition") is not None
            certainty = Certainty.LIKELY if inside else None
            yield view.hit("python.missing_module", node, message, certainty=certainty)


RULE = FileRule(
    id="python.missing_module",
    title="Import of a module of Python 2",
    finds="An import, outside of `try` and `if`, of a module that Python 3 has under another name: `Queue`, "
    "`urllib2`, `ConfigParser`, `cPickle`, `StringIO`, `Tkinter` and others.",
    why="The node ends with a ModuleNotFoundError before it does anything.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=(),
    syntax="python",
    kinds=("import_statement", "import_from_statement"),
    clauses=("ruff UP",),
    bad="import Queue\n",
    good="import queue\n",
    found=found,
)
