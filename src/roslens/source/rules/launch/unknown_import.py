"""Rule ``launch.unknown_import``: a name is imported from a module of launch that does not have it."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule
from roslens.source.rules.signatures.read_signatures import homes_of, names_of, read_tables, signature_of
from roslens.source.rules.views.launch_code import LIBRARIES, MENTIONS, LaunchCode, imported, launch_code
from roslens.source.rules.views.python_names import above_of, text_of

_SIMILAR = 0.85


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield each import of a module or name that the libraries do not have, and each attribute of a module."""
    code = launch_code(view)
    if code is None:
        return
    for node in (*view.nodes("import_from_statement"), *view.nodes("import_statement")):
        if above_of(node, "try_statement", "if_statement") is None:
            for at, message in (_of_from if node.type == "import_from_statement" else _of_import)(node, code):
                yield view.hit("launch.unknown_import", at, message)
    for call in code.other_calls:
        function = call.child_by_field_name("function")
        module, _, name = code.full_name(function).rpartition(".")
        if function is not None and module and _lacks(module, name, code):
            yield view.hit("launch.unknown_import", function, _no_name(module, name))


def _of_from(node: Node, code: LaunchCode) -> Iterator[tuple[Node, str]]:
    module = text_of(node.child_by_field_name("module_name"))
    if _is_unknown_module(module):
        yield node, _no_module(module)
        return
    for one in node.children_by_field_name("name"):
        name = imported(one)
        if _lacks(module, name, code):
            yield one, _no_name(module, name)


def _of_import(node: Node, _code: LaunchCode) -> Iterator[tuple[Node, str]]:
    for one in node.children_by_field_name("name"):
        if _is_unknown_module(imported(one)):
            yield one, _no_module(imported(one))


def _is_unknown_module(module: str) -> bool:
    """Whether there is no such module, but one of a similar name: an own package called launch may hold any other."""
    library = read_tables().library
    is_other = module in library or module.partition(".")[0] not in LIBRARIES or "." not in module
    return not is_other and bool(get_close_matches(module, library, 1, _SIMILAR))


def _lacks(module: str, name: str, code: LaunchCode) -> bool:
    """Whether a module of the libraries does not have a name; a module ``launch.py`` of somebody else may have any."""
    names = names_of(module)
    if names is None or name.startswith("_") or f"{module}.{name}" in read_tables().library:
        return False
    if module == "launch" and not code.calls and not any(signature_of(one) for one in code.imports.values()):
        return False
    return name not in names or not names[name].is_supported


def _no_module(module: str) -> str:
    close = get_close_matches(module, read_tables().library, 1)
    expected = f"`{close[0]}`" if close else "a module of it"
    return f"there is no module `{module}`: the launch ends with a ModuleNotFoundError; expected {expected}"


def _no_name(module: str, name: str) -> str:
    names = names_of(module) or {}
    gone = f" since {names[name].removed_in}, where it was removed" if name in names else ""
    homes = homes_of(name)
    known = [one for one, span in names.items() if span.is_supported]
    close = get_close_matches(name, known, 1)
    similar = f"`{close[0]}`" if close else "one of its names"
    expected = f"`from {homes[0]} import {name}`" if homes else similar
    return f"`{module}` has no `{name}`{gone}: the launch ends with an ImportError; expected {expected}"


RULE = FileRule(
    id="launch.unknown_import",
    title="Name that a module of launch does not have",
    finds="An import of a module or name that `launch`, `launch_ros`, `launch_xml` or `launch_yaml` has in no "
    "supported distribution, such as `from launch.actions import Node`, and a call of such a name by its module. "
    "Imports in `try` and `if` are left out.",
    why="Python raises an ImportError while the launch file is read: nothing starts.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("launch",),
    syntax="python",
    whole=True,
    gathers=("import_statement", "import_from_statement"),
    mentions=MENTIONS,
    bad="from launch.actions import Node",
    good="from launch_ros.actions import Node",
    found=found,
)
