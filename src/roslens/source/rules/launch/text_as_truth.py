"""Rule ``launch.text_as_truth``: the text of a launch argument is tested as if it were a bool."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule
from roslens.source.rules.views.launch_code import MENTIONS, TRUTH, LaunchCall, LaunchCode, launch_code, shown, tested
from roslens.source.rules.views.python_names import text_of

_BOOLS = frozenset({"true", "false", "0", "1"})
_TESTS = (
    "if_statement",
    "elif_clause",
    "while_statement",
    "conditional_expression",
    "not_operator",
    "boolean_operator",
)
_INSTEAD = "expected a comparison such as `.lower() == 'true'`"


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield each test of the text of an argument that is declared with a bool as its default."""
    code = launch_code(view)
    if code is None:
        return
    defaults = _defaults(code)
    for node, one in _all_tested(code):
        name = _argument(one, code)
        if name and defaults.get(name, "").lower() in _BOOLS:
            yield view.hit("launch.text_as_truth", node, _message(name, defaults[name]))
    for node in view.nodes("comparison_operator"):
        name = next((name for one in node.named_children if (name := _argument(one, code))), "")
        if name and any(one.type in ("true", "false") for one in node.named_children):
            what = f"{shown(node, code)} compares the text of argument {name!r} with a bool: they are never equal"
            yield view.hit("launch.text_as_truth", node, f"{what}; {_INSTEAD}")


def _all_tested(code: LaunchCode) -> Iterator[tuple[Node, Node]]:
    """Yield what is tested, and what calls of ``bool`` are given, each with the node that is reported."""
    for kind in _TESTS:
        yield from ((one, one) for node in code.view.nodes(kind) for one in tested(node))
    for node in code.view.nodes("call"):
        arguments = node.child_by_field_name("arguments")
        if arguments is not None and code.full_name(node.child_by_field_name("function")) == "bool":
            yield from ((node, one) for one in arguments.named_children)


def _argument(node: Node, code: LaunchCode) -> str:
    """Return the name of the launch argument whose text an expression is; empty for other expressions."""
    value = code.value(node)
    if value is None or value.type not in ("subscript", "call"):
        return ""
    if value.type == "subscript":
        return _of_context(value.child_by_field_name("value"), value.child_by_field_name("subscript"), code)
    function, arguments = value.child_by_field_name("function"), value.child_by_field_name("arguments")
    first = arguments.named_children[0] if arguments is not None and arguments.named_child_count else None
    if function is None or first is None:
        return ""
    of, method = function.child_by_field_name("object"), text_of(function.child_by_field_name("attribute"))
    if method in ("perform", "perform_substitution"):
        return _of_configuration(code.call(code.value(of if method == "perform" else first)), code)
    return _of_context(of, first, code) if method == "get" else ""


def _of_configuration(call: LaunchCall | None, code: LaunchCode) -> str:
    is_one = call is not None and call.name == "LaunchConfiguration"
    return (code.text(call.argument("variable_name")) or "") if call is not None and is_one else ""


def _of_context(of: Node | None, key: Node | None, code: LaunchCode) -> str:
    is_configurations = text_of(of).endswith(".launch_configurations")
    return (code.text(key) or "") if is_configurations else ""


def _defaults(code: LaunchCode) -> Mapping[str, str]:
    """Return the default of each argument that the file declares with a text that is written out."""
    found: dict[str, str] = {}
    for call in code.calls:
        if call.name in ("DeclareLaunchArgument", "DeclareBooleanLaunchArgument"):
            name, default = code.text(call.argument("name")), call.argument("default_value")
            text = "true" if code.sort(default) == TRUTH else code.text(default)
            if name and call.name == "DeclareBooleanLaunchArgument":
                text = "true"
            if name and text is not None:
                found[name] = text
    return found


def _message(name: str, default: str) -> str:
    what = f"the text of argument {name!r} (default {default!r}) is tested for being empty"
    return f"{what}: 'false' is a text, and true in Python; {_INSTEAD}"


RULE = FileRule(
    id="launch.text_as_truth",
    title="Text of an argument tested as a bool",
    finds="A test of what `LaunchConfiguration(…).perform(context)` or `context.launch_configurations[…]` returns, "
    "where the file declares the argument with `true`, `false`, `0` or `1` as its default; and a comparison of it "
    "with `True` or `False`. Arguments with other defaults are left out: they are tested for being empty.",
    why="Launch arguments are texts, and `'false'` is true in Python: what the argument should turn off always runs.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("launch",),
    syntax="python",
    whole=True,
    gathers=(*_TESTS, "comparison_operator", "call"),
    mentions=MENTIONS,
    bad="from launch.actions import DeclareLaunchArgument\nfrom launch.substitutions import LaunchConfiguration\n\n"
    "use_rviz = DeclareLaunchArgument('use_rviz', default_value='false')\n\n\ndef setup(context):\n"
    "    if LaunchConfiguration('use_rviz').perform(context):\n        print('starts RViz')",
    good="from launch.actions import DeclareLaunchArgument\nfrom launch.substitutions import LaunchConfiguration\n\n"
    "use_rviz = DeclareLaunchArgument('use_rviz', default_value='false')\n\n\ndef setup(context):\n"
    "    if LaunchConfiguration('use_rviz').perform(context).lower() == 'true':\n        print('starts RViz')",
    found=found,
)
