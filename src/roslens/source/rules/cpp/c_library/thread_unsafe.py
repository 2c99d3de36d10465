"""Rule ``cpp.thread_unsafe``: a function that keeps its result in one place for all threads."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_statement import free_call
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each call of one of these functions."""
    if free_call(node, view) is not None:
        yield view.hit(
            "cpp.thread_unsafe",
            node,
            f"`{view.text(node)}` shares its state among threads; expected the form that ends in _r, or <random>",
        )


RULE = FileRule(
    id="cpp.thread_unsafe",
    title="Function that is not safe in threads",
    finds="`strtok`, `localtime`, `gmtime`, `asctime`, `ctime`, `getpwnam`, `getpwuid`, `getgrgid`, `getgrnam`, "
    "`getlogin`, `ttyname` and `rand` share one result or state among all threads. Use the form that ends "
    "in `_r`.",
    why="Two callbacks of a multi-threaded executor overwrite the result of each other.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=(
        "google",
        "safety",
        "paper2016",
    ),
    clauses=(
        "cpplint runtime/threadsafe_fn",
        "paper2016 thread_safe_functions",
        "clang-tidy concurrency-mt-unsafe",
    ),
    bad="void f(long* t) { print(localtime(t)); }\n",
    good="void f(long* t, tm* result) { print(localtime_r(t, result)); }\n",
    syntax="cpp",
    anchors=(
        "strtok",
        "localtime",
        "gmtime",
        "asctime",
        "ctime",
        "getpwnam",
        "getpwuid",
        "getgrgid",
        "getgrnam",
        "getlogin",
        "ttyname",
        "rand",
    ),
    found=found,
)
