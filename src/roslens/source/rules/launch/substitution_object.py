"""Rule ``launch.substitution_object``: the object of a substitution is used as if it were its value."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule
from roslens.source.rules.signatures.read_signatures import SUBSTITUTION
from roslens.source.rules.views.launch_code import (
    DICTIONARY,
    LIST,
    MENTIONS,
    NOTHING,
    NUMBER,
    TEXT,
    TUPLE,
    LaunchCode,
    launch_code,
    shown,
    tested,
)
from roslens.source.rules.views.python_names import text_of

_INSTEAD = "expected a list of parts, `PythonExpression`, or `.perform(context)` in an OpaqueFunction"
_METHODS = frozenset({
    "lower", "upper", "strip", "split", "replace", "startswith", "endswith", "format", "join", "encode", "rstrip",
    "lstrip",
})  # fmt: skip
"""Of texts; a substitution has none of them."""
_REFUSES = frozenset({
    "os.path.join", "os.path.exists", "os.path.isfile", "os.path.isdir", "os.path.basename", "os.path.dirname",
    "os.path.splitext", "os.path.abspath", "os.path.expanduser", "os.listdir", "os.makedirs", "open", "int", "float",
    "json.loads", "range", "len", "xacro.process_file", "xacro.process", "xacro.parse",
    "ament_index_python.packages.get_package_share_directory", "ament_index_python.get_package_share_directory",
    "ament_index_python.packages.get_package_share_path", "ament_index_python.packages.get_package_prefix",
})  # fmt: skip
"""Functions that raise a TypeError where they are given the object of a substitution."""
_TRUTHS = (
    "if_statement", "elif_clause", "while_statement", "conditional_expression", "not_operator", "boolean_operator",
)  # fmt: skip
_EQUAL = frozenset({"==", "!=", "is", "is not"})
_UNEQUAL = frozenset({"!=", "is not"})
_LOOKING = frozenset({"in", "not in"})
_IN_TEXTS = ("argument_list", "binary_operator", "parenthesized_expression", "concatenated_string", "interpolation")
_AS_TEXT = "the text of an object, `<launch.substitutions…>`, not its value"
_LOOKS_UP = "looks up an object of a substitution, not its value"
_Found = Iterator[tuple[Node, str, Certainty | None]]


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield each place where Python computes with the object of a substitution."""
    code = launch_code(view)
    if code is None:
        return
    for kind, judge in _JUDGES.items():
        for node in view.nodes(kind):
            for at, message, certainty in judge(node, code):
                yield view.hit("launch.substitution_object", at, f"{message}; {_INSTEAD}", certainty=certainty)


def _comparison(node: Node, code: LaunchCode) -> _Found:
    sides = node.named_children
    operators = [text_of(one) for one in node.children if one not in sides]
    if len(sides) != 2 or len(operators) != 1 or not any(code.is_substitution(one) for one in sides):
        return
    operator, sorts, what = operators[0], [code.sort(one) for one in sides], shown(node, code)
    if NOTHING in sorts or (operator in _LOOKING and sorts[1] in ("", DICTIONARY)):
        return
    if operator in _EQUAL:
        yield node, f"{what} compares objects, not values: it is always {operator in _UNEQUAL}", Certainty.LIKELY
    elif operator in _LOOKING and sorts[1] in (LIST, TUPLE):
        yield node, f"{what} looks for an object, not for its value: always {operator != 'in'}", Certainty.LIKELY
    else:
        yield node, f"{what} compares the object of a substitution: a TypeError", None


def _truth(node: Node, code: LaunchCode) -> _Found:
    for one in tested(node):
        if code.is_substitution(one):
            what = f"{shown(one, code)} is tested while the file is read: an object is always true"
            yield one, what, Certainty.LIKELY


def _text(node: Node, code: LaunchCode) -> _Found:
    for one in node.named_children:
        inner = one.named_children[0] if one.type == "interpolation" and one.named_child_count else None
        if inner is not None and code.is_substitution(inner) and not _is_printed(node):
            yield one, f"{shown(inner, code)} in an f-string is {_AS_TEXT}", None


def _operator(node: Node, code: LaunchCode) -> _Found:
    left, right = node.child_by_field_name("left"), node.child_by_field_name("right")
    operator = text_of(node.child_by_field_name("operator"))
    sorts = [code.sort(left), code.sort(right)]
    if operator == "+" and SUBSTITUTION in sorts and {*sorts} <= {SUBSTITUTION, TEXT, LIST, NUMBER}:
        yield node, f"{shown(node, code)} adds to the object of a substitution: a TypeError", None
    elif operator == "%" and sorts[0] == TEXT and _holds(right, code) and not _is_printed(node):
        yield node, f"{shown(node, code)} has {_AS_TEXT}", None


def _holds(node: Node | None, code: LaunchCode) -> bool:
    return any(code.is_substitution(one) for one in (node, *code.items(node)))


def _subscript(node: Node, code: LaunchCode) -> _Found:
    of = node.child_by_field_name("value")
    for one in node.children_by_field_name("subscript"):
        if code.is_substitution(one) and not code.is_substitution(of):
            error = "TypeError" if code.sort(of) in (LIST, TUPLE, TEXT) else "KeyError"
            yield node, f"{shown(node, code)} {_LOOKS_UP}: a {error}", None


def _call(node: Node, code: LaunchCode) -> _Found:
    function, arguments = node.child_by_field_name("function"), node.child_by_field_name("arguments")
    if function is None or arguments is None or code.call(node) is not None:
        return
    name, what = code.full_name(function), shown(node, code)
    given = [one for one in arguments.named_children if code.is_substitution(one)]
    if given and name in _REFUSES:
        yield node, f"{what} is given the object of a substitution: a TypeError", None
    elif given and name == "bool":
        yield node, f"{what} is always True: it is given an object, not its value", Certainty.LIKELY
    elif given and name == "str" and not _is_printed(node):
        yield node, f"{what} is {_AS_TEXT}", None
    elif function.type == "attribute":
        yield from _method(node, function, arguments, code)


def _method(node: Node, function: Node, arguments: Node, code: LaunchCode) -> _Found:
    of, name = function.child_by_field_name("object"), text_of(function.child_by_field_name("attribute"))
    given = [one for one in arguments.named_children if code.is_substitution(one)]
    what = shown(node, code)
    if code.is_substitution(of) and name in _METHODS:
        yield node, f"{what} calls a method of texts of the object of a substitution: an AttributeError", None
    elif code.is_substitution(of) and name == "perform" and not arguments.named_child_count:
        yield node, f"{what} lacks the launch context: a TypeError", None
    elif given and name == "format" and code.sort(of) == TEXT and not _is_printed(node):
        yield node, f"{what} has {_AS_TEXT}", None
    elif name == "get" and code.sort(of) == DICTIONARY and given and given[0] == arguments.named_children[0]:
        yield node, f"{what} {_LOOKS_UP}: it is never there", None


def _is_printed(node: Node) -> bool:
    """Whether a text is only printed."""
    around = node.parent
    while around is not None and around.type in _IN_TEXTS:
        around = around.parent
    name = text_of(around.child_by_field_name("function")) if around is not None and around.type == "call" else ""
    return name == "print" or name.rpartition(".")[2] in ("info", "debug", "warning", "error")


_JUDGES: dict[str, Callable[[Node, LaunchCode], _Found]] = {
    "comparison_operator": _comparison,
    "string": _text,
    "binary_operator": _operator,
    "subscript": _subscript,
    "call": _call,
    **dict.fromkeys(_TRUTHS, _truth),
}

RULE = FileRule(
    id="launch.substitution_object",
    title="Substitution used before it has a value",
    finds="Python that computes with the object of a substitution, such as `LaunchConfiguration('x')`, while the "
    "launch file is read: in an f-string, `%`, `format` or `str`, as an index, added to a text, given to "
    "`os.path.join`, `open` or `int`; and methods of texts called of it. Comparisons and tests of it, which are "
    "always true or always false, are warnings.",
    why="A substitution has a value only when launch visits the action. Before, Python sees an object: the launch ends "
    "with an exception, or does the same whatever the argument is.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("launch",),
    syntax="python",
    whole=True,
    gathers=("comparison_operator", "string", "binary_operator", "subscript", "call", *_TRUTHS),
    mentions=MENTIONS,
    bad="from launch.substitutions import LaunchConfiguration\n\nrobot = LaunchConfiguration('robot')\n"
    "file = f'/etc/robots/{robot}.yaml'",
    good="from launch.substitutions import LaunchConfiguration\n\nrobot = LaunchConfiguration('robot')\n"
    "file = ['/etc/robots/', robot, '.yaml']",
    found=found,
)
