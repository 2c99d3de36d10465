"""Rule ``cpp.unbounded_copy``: text that is written past the end of its buffer."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_statement import arguments_of, free_call
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each call that writes text of any length."""
    call = free_call(node, view)
    if call is None:
        return
    name, arguments = view.text(node), arguments_of(call)
    if name in ("strcpy", "strcat", "stpcpy") and arguments and arguments[-1].type == "string_literal":
        return
    is_bounded = False
    if name == "sprintf" and len(arguments) > 1:
        form = arguments[1]
        is_bounded = "string" in form.type and "%s" not in view.text(form)
    instead = "std::string" if name in ("strcpy", "strcat", "stpcpy", "gets") else "`snprintf`"
    certainty = Certainty.HEURISTIC if is_bounded else None
    yield view.hit(
        "cpp.unbounded_copy", node, f"`{name}` writes without a limit; expected {instead}", certainty=certainty
    )


RULE = FileRule(
    id="cpp.unbounded_copy",
    title="Text copied without a limit",
    finds="`strcpy`, `strcat`, `stpcpy`, `sprintf`, `vsprintf` and `gets` write as long as the text is, "
    "whatever the buffer holds. Use `std::string`, or `snprintf` with the size. Literals that are copied "
    "are let be.",
    why="A long device name or topic overwrites what lies behind the buffer: the node dies, or worse, goes on.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=(
        "ros2",
        "ros1",
        "google",
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "safety",
        "paper2016",
    ),
    clauses=(
        "cpplint runtime/printf",
        "misra-cpp-2008 18-0-5",
        "misra-cpp-2023 21.2.2",
        "autosar-cpp14 M18-0-5",
        "paper2016 c_string_print",
        "clang-tidy clang-analyzer-security.insecureAPI.strcpy",
    ),
    bad="void f(char* to, const char* from) { strcpy(to, from); }\n",
    good="void f(std::string& to, const char* from) { to = from; }\n",
    syntax="cpp",
    anchors=(
        "strcpy",
        "strcat",
        "stpcpy",
        "sprintf",
        "vsprintf",
        "gets",
    ),
    found=found,
)
