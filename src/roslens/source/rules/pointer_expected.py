"""Whether a place in C++ is certainly one for a pointer, as far as one file shows."""

from __future__ import annotations

import re
from typing import cast

from tree_sitter import Node

from roslens.source.rules.callbacks import callee_name
from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.file_view import FileView, above

_TAKES_POINTERS = frozenset(
    (
        *("time", "gettimeofday", "pthread_create", "pthread_join", "select", "pselect", "strtol", "strtoul", "strtod"),
        *("strtof", "strtoll", "strtoull", "sigaction", "pthread_mutex_init", "pthread_cond_init", "setitimer"),
        *("wait", "waitpid", "accept", "clock_nanosleep", "nanosleep", "realpath", "setlocale", "tcsetattr"),
    )
)
"""Functions of the C library each of whose arguments that may be null is a pointer."""
_GIVES_POINTERS = frozenset(("getenv", "fopen", "dynamic_cast", "strchr", "strstr", "strrchr", "opendir", "readdir"))
_NUMBERS = (
    rb"(?:int|bool|char|short|long|unsigned|size_t|float|double|auto|u?int\d+_t|pthread_t|uint|[A-Z]\w*(?:_t|ID|Id))"
)
_NUMBER = re.compile(rb"\b%s[ \t&]+\Z" % _NUMBERS)
_BEHIND_NUMBER = re.compile(rb"[ \t]*[;,=){(\[]")
_POINTER = re.compile(rb"(?:\*[ \t]*(?:const[ \t]+)?|(?:unique_ptr|shared_ptr|weak_ptr|function)<[^;{}()]*>[ \t]*)\Z")
_BEHIND_POINTER = re.compile(rb"[ \t]*(?:[;,=){]|\(NULL)")
_FARTHEST = 300
"""How far before a name its type is looked for."""


def is_pointer_expected(node: Node, view: FileView) -> bool:
    """Return whether the null at a node is certainly taken for a pointer."""
    around = node.parent
    # The word is a token below the literal.
    if around is not None and around.type == "null":
        node, around = around, around.parent
    if around is None or around.has_error:
        return False
    if around.type in ("init_declarator", "optional_parameter_declaration", "field_declaration"):
        named = around.child_by_field_name("declarator")
        return named is not None and named.type in ("pointer_declarator", "abstract_pointer_declarator")
    if around.type == "assignment_expression":
        return _is_pointer(around.child_by_field_name("left"), view)
    if around.type == "binary_expression" and around.child_by_field_name("operator") is not None:
        sides = (around.child_by_field_name("left"), around.child_by_field_name("right"))
        sign = view.text(around.child_by_field_name("operator"))
        return sign in ("==", "!=") and any(_is_pointer(one, view) for one in sides if one != node)
    if around.type == "return_statement":
        return _returns_pointer(around)
    if around.type == "argument_list":
        return _is_argument(around, view)
    return False


def _is_argument(arguments: Node, view: FileView) -> bool:
    call = arguments.parent
    if call is None:
        return False
    if call.type == "call_expression":
        return callee_name(call, view) in _TAKES_POINTERS
    if call.type == "field_initializer" and arguments.named_child_count == 1:
        return is_declared_pointer(view.text(call.named_children[0]), view)
    if call.type == "init_declarator" and arguments.named_child_count == 1:
        named = call.child_by_field_name("declarator")
        return named is not None and named.type == "pointer_declarator"
    return False


def _is_pointer(node: Node | None, view: FileView) -> bool:
    while node is not None and node.type == "parenthesized_expression" and node.named_child_count == 1:
        node = node.named_children[0]
    if node is None:
        return False
    if node.type == "assignment_expression":
        return _is_pointer(node.child_by_field_name("left"), view)
    if node.type == "call_expression":
        return callee_name(node, view) in _GIVES_POINTERS
    name = node
    if node.type == "field_expression" and view.text(node.child_by_field_name("argument")) == "this":
        name = node.child_by_field_name("field") or node
    return name.type in ("identifier", "field_identifier") and is_declared_pointer(view.text(name), view)


def _returns_pointer(statement: Node) -> bool:
    function = above(statement, "function_definition", "lambda_expression")
    if function is None or function.type != "function_definition":
        return False
    declarator = function.child_by_field_name("declarator")
    return declarator is not None and declarator.type == "pointer_declarator"


def is_declared_pointer(name: str, view: FileView) -> bool:
    """Return whether a file declares a name as a pointer, and nowhere as what may be a number."""
    key = ("pointer", name)
    found = view.kept.get(key)
    if found is None:
        found = view.kept[key] = _is_declared_pointer(name.encode(), view)
    return cast("bool", found)


def _is_declared_pointer(word: bytes, view: FileView) -> bool:
    code, is_pointer = view.code, False
    for at in word_places(word, view):
        end = at + len(word)
        before = code[max(0, at - _FARTHEST) : at]
        if _BEHIND_NUMBER.match(code, end) and _NUMBER.search(before):
            return False
        is_pointer = is_pointer or bool(_BEHIND_POINTER.match(code, end) and _POINTER.search(before))
    return is_pointer
