"""Rule ``node.lifecycle_publisher_inactive``: a lifecycle node that is active, with a publisher that is not."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callee_name, function_name
from roslens.source.rules.calls import body_of, call_at, receiver
from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.cpp_class import bases_of, class_name
from roslens.source.rules.cpp_flow.member_facts import member_fact
from roslens.source.rules.cpp_flow.variable_type import class_around, type_of
from roslens.source.rules.file_view import FileView, above, below
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_ACTIVATE = "on_activate"
_CREATE = b"create_publisher"
_KIND = "LifecyclePublisher"
"""Of a publisher: through a pointer to a plain `rclcpp::Publisher` messages go out all the same."""
_HELPER = re.compile(r"activ|publish|start|enable|resume", re.IGNORECASE)


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a definition of ``on_activate`` that leaves a publisher of its node inactive."""
    declarator = above(node, "function_declarator", "compound_statement")
    function = above(node, "function_definition", "compound_statement")
    body = body_of(function) if function is not None else None
    if declarator is None or function is None or body is None or not _is_transition(declarator, view):
        return
    of_class = class_around(body, view)
    if not of_class or not _is_managed(of_class, view) or _activates(body, of_class, view):
        return
    for name, line in _publishers(of_class, view).items():
        kind = type_of(f"this->{name}", body, view)
        if _is_activated(name, view) or not _publishes(name, view) or (kind and not _is_lifecycle(kind, view)):
            continue
        yield view.hit(
            "node.lifecycle_publisher_inactive",
            declarator,
            f"`{function_name(function, view)}` calls neither the `on_activate` of its base class nor that of `{name}` "
            f"(line {line}): a lifecycle publisher that was never activated drops every message; expected "
            "`LifecycleNode::on_activate(state)`",
            callback="" if kind else member_fact(of_class, name, _KIND),
        )
        if not kind:
            continue
        return


def _is_lifecycle(kind: str, view: FileView) -> bool:
    """Return whether a type is one of lifecycle publishers, by its name or that of which it is an alias."""
    alias = re.escape(kind.partition("::")[0])
    return _KIND in kind or view.has(re.compile(rf"\busing\s+{alias}\s*=[^;]*{_KIND}".encode()))


def _is_transition(declarator: Node, view: FileView) -> bool:
    parameters = view.text(declarator.child_by_field_name("parameters"))
    name = view.text(declarator.child_by_field_name("declarator")).rpartition("::")[2]
    return name == _ACTIVATE and re.search(r"\bState\b", parameters) is not None


def _is_managed(of_class: str, view: FileView) -> bool:
    """Return whether a class derives from a lifecycle node, as far as the file tells."""
    for word in word_places(of_class.encode(), view):
        name = view.node_at(word, word + len(of_class))
        cls = name.parent if name is not None else None
        if (
            cls is not None
            and cls.type in ("class_specifier", "struct_specifier")
            and class_name(cls, view) == of_class
        ):
            if cls.child_by_field_name("body") is None:
                continue
            return any(base.partition("<")[0].endswith("LifecycleNode") for base in bases_of(cls, view))
    return b"LifecycleNode" in view.code


def _activates(body: Node, of_class: str, view: FileView) -> bool:
    """Return whether a body activates publishers in ways that need not name one: by its base class, by a helper."""
    for call in below(body, "call_expression"):
        name, of = callee_name(call, view), receiver(call)
        written = view.text(call.child_by_field_name("function"))
        if name == _ACTIVATE and of is None:
            return True
        is_own = of is None or view.text(of) == "this"
        is_helper = is_own and "::" not in written.partition("<")[0] and _HELPER.search(name) is not None
        if is_helper and not _is_defined(f"{of_class}::{name}", view):
            return True
    return False


def _is_defined(name: str, view: FileView) -> bool:
    word = name.rpartition("::")[2].encode()
    for at in word_places(word, view):
        node = view.node_at(at, at + len(word))
        declarator = above(node, "function_declarator", "compound_statement") if node is not None else None
        function = declarator.parent if declarator is not None else None
        if function is not None and function.type == "function_definition" and function_name(function, view) == name:
            return True
    return False


def _publishers(of_class: str, view: FileView) -> dict[str, int]:
    """Return the members that hold publishers which the node itself creates, with the lines where it does."""
    found_: dict[str, int] = {}
    for at in word_places(_CREATE, view):
        word = view.node_at(at, at + len(_CREATE))
        call = call_at(word) if word is not None else None
        made = call.parent if call is not None else None
        if call is None or made is None or made.type != "assignment_expression":
            continue
        of = receiver(call)
        is_own = of is None and view.text(call.child_by_field_name("function")).startswith(_CREATE.decode())
        name = view.text(made.child_by_field_name("left")).removeprefix("this->")
        if (is_own or view.text(of) == "this") and name.isidentifier() and class_around(call, view) == of_class:
            found_.setdefault(name, call.start_point[0] + 1)
    return found_


def _is_activated(name: str, view: FileView) -> bool:
    """Return whether the publisher is activated somewhere, or something that may stand for it is."""
    pattern = re.compile(rb"([\w>\].()-]+?)\s*(?:->|\.)\s*on_activate\s*\(\s*\)")
    receivers = {match[1].decode("utf-8", "replace").removeprefix("this->") for match in pattern.finditer(view.code)}
    known = {
        one for one in receivers if re.search(rf"\b{re.escape(one)}\s*=[^;=]*\bcreate_publisher\b".encode(), view.code)
    }
    return name in receivers or bool(receivers - known)


def _publishes(name: str, view: FileView) -> bool:
    return re.search(rb"\b" + name.encode() + rb"\s*->\s*publish\s*\(", view.code) is not None


RULE = FileRule(
    id="node.lifecycle_publisher_inactive",
    title="Lifecycle publisher that is never activated",
    finds="A lifecycle node that overrides `on_activate` and calls neither the method of its base class nor "
    "`on_activate()` of a publisher that it creates and publishes with. Call the base class.",
    why="`LifecycleNode::on_activate` activates the publishers that the node created. Without it they drop every "
    "message, with one warning in the log: the node is active and nothing arrives.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("lifetime", "endpoints"),
    bad="""#include <rclcpp_lifecycle/lifecycle_node.hpp>
class Gauge : public rclcpp_lifecycle::LifecycleNode {
  Return on_configure(const State &) override { pub_ = create_publisher<Level>("level", 10); return Return::SUCCESS; }
  LifecyclePublisher<Level>::SharedPtr pub_;
  Return on_activate(const State &) override { return Return::SUCCESS; }
  void tick() { pub_->publish(level_); }
};
""",
    good="""#include <rclcpp_lifecycle/lifecycle_node.hpp>
class Gauge : public rclcpp_lifecycle::LifecycleNode {
  Return on_configure(const State &) override { pub_ = create_publisher<Level>("level", 10); return Return::SUCCESS; }
  LifecyclePublisher<Level>::SharedPtr pub_;
  Return on_activate(const State & state) override { LifecycleNode::on_activate(state); return Return::SUCCESS; }
  void tick() { pub_->publish(level_); }
};
""",
    syntax="cpp",
    anchors=(_ACTIVATE,),
    mentions=("Lifecycle",),
    spares_tests=True,
    found=found,
)
