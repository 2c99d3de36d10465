"""Rule ``launch.unknown_import``: a name is imported from a module of launch that does not have it."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from tree_sitter import Node

from roslens.model.finding import Severity
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule
from roslens.source.rules.signatures.read_signatures import homes_of, names_of, read_tables, signature_of
from roslens.source.rules.views.launch_code import LIBRARIES, MENTIONS, LaunchCode, launch_code
from roslens.source.rules.views.python_names import above_of, text_of

_SIMILAR = 0.85


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield each import of a module or name that the libraries do not have, and each attribute of a module."""
    code = launch_code(view)
    if code is None:
        return
    for node in view.nodes("import_from_statement"):
        module = text_of(node.child_by_field_name("module_name"))
        if above_of(node, "try_statement", "if_statement") is None and _is_of_ros(module, code):
            yield from _of_import(node, view)
    for node in view.nodes("import_statement"):
        for one in node.children_by_field_name("name"):
            module = text_of(one.child_by_field_name("name") if one.type == "aliased_import" else one)
            if _is_unknown_module(module) and above_of(node, "try_statement", "if_statement") is None:
                yield view.hit("launch.unknown_import", one, _no_module(module))
    for call in code.other_calls:
        function = call.child_by_field_name("function")
        module, _, name = code.full_name(function).rpartition(".")
        if function is not None and module and _lacks(module, name) and _is_of_ros(module, code):
            yield view.hit("launch.unknown_import", function, _no_name(module, name))


def _of_import(node: Node, view: FileView) -> Iterator[Hit]:
    module = text_of(node.child_by_field_name("module_name"))
    if _is_unknown_module(module):
        yield view.hit("launch.unknown_import", node, _no_module(module))
        return
    for one in node.children_by_field_name("name"):
        name = text_of(one.child_by_field_name("name") if one.type == "aliased_import" else one)
        if _lacks(module, name):
            yield view.hit("launch.unknown_import", one, _no_name(module, name))


def _is_unknown_module(module: str) -> bool:
    """Whether there is no such module, but one of a similar name: an own package called launch may hold any other."""
    library = read_tables().library
    is_other = module in library or module.partition(".")[0] not in LIBRARIES or "." not in module
    return not is_other and bool(get_close_matches(module, library, 1, _SIMILAR))


def _is_of_ros(module: str, code: LaunchCode) -> bool:
    """Whether ``launch`` is that of ROS, not a module ``launch.py`` of somebody else."""
    return module != "launch" or any(signature_of(one) is not None for one in code.imports.values()) or bool(code.calls)


def _lacks(module: str, name: str) -> bool:
    names = names_of(module)
    if names is None or name.startswith("_"):
        return False
    if f"{module}.{name}" in read_tables().library:
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
    severity=Severity.ERROR,
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
