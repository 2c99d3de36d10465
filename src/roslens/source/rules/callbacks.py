"""Which functions are callbacks: handed to a subscription, timer, service, action or parameter hook.

A function is named by its last two parts, ``Class::method`` in C++ and ``Class.method`` in Python, or by its name alone
outside of a class: a header declares what another file registers, and neither needs to write the namespace.
"""

from __future__ import annotations

from collections.abc import Iterator, Set

from tree_sitter import Node

from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.file_view import FileView, above, all_above, below

REGISTERING_CPP = frozenset(
    (
        *("create_subscription", "create_generic_subscription", "create_wall_timer", "create_timer", "create_service"),
        *("create_server", "add_on_set_parameters_callback", "add_post_set_parameters_callback"),
        *("add_parameter_callback", "subscribe", "createTimer", "createWallTimer", "createSteadyTimer"),
        *("advertiseService", "registerCallback", "setCallback", "async_send_request", "registerGoalCallback"),
        *("registerPreemptCallback", "sendGoal", "async_send_goal"),
    )
)
"""Names of what takes a callback as an argument, in roscpp, rclcpp and what stands on them."""

REGISTERING_PYTHON = frozenset(
    (
        *("create_subscription", "create_timer", "create_service", "ActionServer", "SimpleActionServer", "Subscriber"),
        *("Service", "Timer", "registerCallback", "add_on_set_parameters_callback", "add_done_callback", "Server"),
    )
)
"""The same in rospy, rclpy and what stands on them."""

_WORDS = {
    syntax: frozenset(name.encode() for name in names)
    for syntax, names in (("cpp", REGISTERING_CPP), ("python", REGISTERING_PYTHON))
}

STREAM = "stream "
"""Before the name of a callback that runs again and again: of a subscription or a timer."""

_STREAM_CPP = frozenset(
    (
        *("create_subscription", "create_generic_subscription", "create_wall_timer", "create_timer", "subscribe"),
        *("createTimer", "createWallTimer", "createSteadyTimer", "registerCallback"),
    )
)
_STREAM_PYTHON = frozenset(("create_subscription", "create_timer", "Subscriber", "Timer", "registerCallback"))

_CPP_FUNCTIONS = ("function_definition",)
_PYTHON_FUNCTIONS = ("function_definition", "lambda")


def callbacks_of(view: FileView) -> tuple[str, ...]:
    """Return the names of the functions that a file registers as callbacks, sorted.

    Those of subscriptions and timers are named once more, after :data:`STREAM`.
    """
    if _WORDS[view.syntax].isdisjoint(view.words):
        return ()
    streams = _STREAM_CPP if view.syntax == "cpp" else _STREAM_PYTHON
    found: set[str] = set()
    for call in _registrations(view):
        if view.text(call.child_by_field_name("function")) == "threading.Timer":
            # It calls once, and in a thread of its own.
            continue
        named = set(_named_cpp(call, view) if view.syntax == "cpp" else _named_python(call, view))
        found |= named
        if callee_name(call, view) in streams and b"cancel()" not in view.code[call.start_byte : call.end_byte]:
            found.update(STREAM + name for name in named)
    return tuple(sorted(found))


def callback_around(node: Node, view: FileView, *, of_stream: bool = False) -> str | None:
    """Return the function around a node that has to be a callback for the node to run in one.

    The text is empty where the node certainly runs in one (a lambda that is handed over), None where no function or
    another lambda is around it. With ``of_stream`` only callbacks of subscriptions and timers count.
    """
    for one in all_above(node):
        if one.type == "function_definition":
            return _name_as_callback(one, view, of_stream=of_stream)
        if one.type == "lambda_expression" or (view.syntax == "python" and one.type == "lambda"):
            return "" if _is_handed_over(one, view, _registering(view, of_stream=of_stream)) else None
    return None


def _registering(view: FileView, *, of_stream: bool) -> frozenset[str]:
    """Return the functions that callbacks are handed over to."""
    if view.syntax == "cpp":
        return _STREAM_CPP if of_stream else REGISTERING_CPP
    return _STREAM_PYTHON if of_stream else REGISTERING_PYTHON


def _name_as_callback(function: Node, view: FileView, *, of_stream: bool) -> str | None:
    if of_stream and runs_once(function, view):
        return None
    name = function_name(function, view)
    return (STREAM + name if of_stream else name) if name else None


def runs_once(function: Node, view: FileView) -> bool:
    """Return whether a function cancels a timer, as one does that sets things up and then ends itself."""
    return view.code.find(b"cancel()", function.start_byte, function.end_byte) >= 0


def function_name(function: Node, view: FileView) -> str:
    """Return the last two parts of a function's qualified name, the class and its own, or its name alone."""
    if view.syntax == "python":
        name = view.text(function.child_by_field_name("name"))
        around = above(function, "class_definition", "function_definition")
        if around is not None and around.type == "class_definition":
            return f"{view.text(around.child_by_field_name('name'))}.{name}"
        return name
    declarator = function.child_by_field_name("declarator")
    while declarator is not None and declarator.type != "function_declarator":
        declarator = declarator.child_by_field_name("declarator") or next(
            (child for child in declarator.children if child.type == "function_declarator"), None
        )
    named = declarator.child_by_field_name("declarator") if declarator is not None else None
    parts = view.text(named).split("::")[-2:] if named is not None else [""]
    if len(parts) == 1:
        around = above(function, "class_specifier", "struct_specifier")
        if around is not None:
            parts.insert(0, view.text(around.child_by_field_name("name")).rpartition("::")[2])
    return "::".join(part.partition("<")[0] for part in parts)


def callee_name(call: Node, view: FileView) -> str:
    """Return the last part of what a call calls, without template arguments: ``f`` of ``n->f<T>()``."""
    callee = call.child_by_field_name("function")
    while callee is not None:
        inner = callee.child_by_field_name("field") or callee.child_by_field_name("attribute")
        inner = inner or (callee.child_by_field_name("name") if callee.type != "lambda_expression" else None)
        if inner is None:
            break
        callee = inner
    return view.text(callee).partition("<")[0] if callee is not None else ""


def _registrations(view: FileView) -> Iterator[Node]:
    kind = "call_expression" if view.syntax == "cpp" else "call"
    for word in sorted(_WORDS[view.syntax] & view.words):
        for at in word_places(word, view):
            node = view.node_at(at, at + len(word))
            call = node if node is None or node.type == kind else above(node, kind)
            if call is not None and callee_name(call, view) == word.decode():
                yield call


def _named_cpp(call: Node, view: FileView) -> Iterator[str]:
    arguments = call.child_by_field_name("arguments")
    if arguments is None:
        return
    for one in below(arguments, "pointer_expression", "lambda_expression", inside=("lambda_expression",)):
        if one.type == "pointer_expression":
            yield "::".join(view.text(one.child_by_field_name("argument")).split("::")[-2:])
        else:
            yield from _called_by(one, call, view)


def _called_by(function: Node, call: Node, view: FileView) -> Iterator[str]:
    """Yield the methods of its own class that a lambda hands its message on to.

    Lambdas inside are run by whoever they are given to, such as a thread of their own for the goal of an action.
    """
    around = above(call, *_CPP_FUNCTIONS)
    of_class = function_name(around, view).rpartition("::")[0] if around is not None else ""
    for one in below(function, "call_expression", inside=("lambda_expression",)):
        callee = one.child_by_field_name("function")
        text = view.text(callee)
        name = text.removeprefix("this->")
        if of_class and name.isidentifier():
            yield f"{of_class}::{name}"


def _named_python(call: Node, view: FileView) -> Iterator[str]:
    arguments = call.child_by_field_name("arguments")
    around = above(call, "class_definition")
    of_class = view.text(around.child_by_field_name("name")) if around is not None else ""
    for one in arguments.named_children if arguments is not None else ():
        value = _handed_over(one, view)
        text = view.text(value)
        if value is not None and value.type == "identifier":
            yield text
        elif of_class and text.startswith("self.") and text.count(".") == 1:
            yield f"{of_class}.{text.removeprefix('self.')}"


def _handed_over(argument: Node, view: FileView) -> Node | None:
    """Return the function that an argument comes to: itself, what ``partial`` is given or a lambda calls."""
    value = argument.child_by_field_name("value") if argument.type == "keyword_argument" else argument
    if value is not None and value.type == "call" and callee_name(value, view) == "partial":
        listed = value.child_by_field_name("arguments")
        value = next(iter(listed.named_children), None) if listed is not None else None
    if value is not None and value.type == "lambda":
        body = value.child_by_field_name("body")
        return body.child_by_field_name("function") if body is not None and body.type == "call" else None
    return value


def _is_handed_over(function: Node, view: FileView, names: Set[str]) -> bool:
    kind = "call_expression" if view.syntax == "cpp" else "call"
    call = above(function, kind, "compound_statement", "block")
    while call is not None and call.type == kind:
        if callee_name(call, view) in names:
            return True
        call = above(call, kind, "compound_statement", "block")
    return False


def spoken(callback: str) -> str:
    """Return what a message calls the answer of :func:`callback_around`."""
    return f"callback `{callback.removeprefix(STREAM)}`" if callback else "a callback"
