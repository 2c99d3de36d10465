"""The text of an expression of C++ that is the same in every run, as far as its file tells."""

from __future__ import annotations

import re

from tree_sitter import Node

from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.cpp_class import has_token, name_node
from roslens.source.rules.cpp_statement import arguments_of, callee
from roslens.source.rules.file_view import FileView

_MOST_DEPTH = 30
"""Of constants that are made of others."""
_MAKES = ("std::string", "string", "std::string_view", "string_view")
_READS = (b".c_str()", b".data()", b".size()", b".length()", b".empty()")
"""What leaves a text as it is."""
_BODIES = ("body", "consequence", "alternative")
_SCOPES = ("compound_statement", "case_statement", "declaration_list", "translation_unit")
_TRANSPARENT = ("namespace_definition", "linkage_specification")
_DIRECTIVES = ("preproc_if", "preproc_ifdef", "preproc_else", "preproc_elif")


def constant_text(node: Node | None, view: FileView, depth: int = 0) -> str | None:
    """Return the text of an expression as it is written, without its quotes; None where it is not certain.

    Known are literals, macros of the file that stand for one, variables whose only value is such a text, and what
    ``std::string`` and ``+`` make of them.
    """
    if node is None or depth > _MOST_DEPTH:
        return None
    match node.type:
        case "string_literal" | "raw_string_literal":
            return "".join(view.text(one) for one in node.named_children if one.type != "raw_string_delimiter")
        case "parenthesized_expression" | "concatenated_string" | "initializer_list":
            return _joined([one for one in node.named_children if one.type != "comment"], view, depth)
        case "binary_expression" if view.text(node.child_by_field_name("operator")) == "+":
            return _joined([node.child_by_field_name("left"), node.child_by_field_name("right")], view, depth)
        case "call_expression":
            arguments = arguments_of(node)
            if callee(node, view) in _MAKES and len(arguments) == 1:
                return constant_text(arguments[0], view, depth + 1)
        case "identifier":
            return _of_name(node, view, depth)
    return None


def _joined(parts: list[Node | None], view: FileView, depth: int) -> str | None:
    texts = [constant_text(one, view, depth + 1) for one in parts]
    known = [one for one in texts if one is not None]
    return "".join(known) if known and len(known) == len(texts) else None


def _of_name(name: Node, view: FileView, depth: int) -> str | None:
    """Return the text of a variable or a macro: what its nearest declaration gives it, where nothing changes that."""
    word = view.text(name)
    inside, scope = name, name.parent
    while scope is not None:
        if scope.type in _SCOPES:
            declared = [
                one
                for one in scope.named_children
                if one.type == "declaration" and any(_declares(part, word, view) for part in one.named_children)
            ]
            if declared:
                before = declared[0].end_byte <= name.start_byte and len(declared) == 1
                return _initial(declared[0], word, scope, view, depth) if before else None
        elif scope.type in _DIRECTIVES or (scope.type not in _TRANSPARENT and _may_declare(scope, inside, word, view)):
            return None
        inside, scope = scope, scope.parent
    return _of_macro(word, view)


def _declares(part: Node, word: str, view: FileView) -> bool:
    if part.type == "function_declarator":
        return False
    named = name_node(part)
    return named is not None and view.text(named) == word and part.type != "type_identifier"


def _may_declare(around: Node, inside: Node, word: str, view: FileView) -> bool:
    """Return whether what stands in a node before its body, or beside it in a class, has the name as well."""
    if around.type == "field_declaration_list":
        before, behind = (around.start_byte, inside.start_byte), (inside.end_byte, around.end_byte)
        return _is_named(word, view, *before) or _is_named(word, view, *behind)
    bodies = [around.child_by_field_name(field) for field in _BODIES]
    return inside in bodies and _is_named(word, view, around.start_byte, inside.start_byte)


def _is_named(word: str, view: FileView, start: int, end: int) -> bool:
    return any(True for _ in word_places(word.encode(), view, start, end))


def _initial(declaration: Node, word: str, scope: Node, view: FileView, depth: int) -> str | None:
    """Return the text that a variable begins with, where it keeps it."""
    part = next((one for one in declaration.named_children if _declares(one, word, view)), None)
    if part is None or part.type != "init_declarator" or not _keeps(declaration, part, word, scope, view):
        return None
    value = part.child_by_field_name("value")
    if value is not None and value.type == "argument_list":
        given = [one for one in value.named_children if one.type != "comment"]
        value = given[0] if len(given) == 1 else None
    return constant_text(value, view, depth + 1)


def _keeps(declaration: Node, part: Node, word: str, scope: Node, view: FileView) -> bool:
    declarator = part.child_by_field_name("declarator")
    if declarator is None:
        return False
    fixed = any(has_token(one, "const") or has_token(one, "constexpr") for one in declaration.children)
    if fixed and declarator.type in ("identifier", "array_declarator"):
        return True
    return scope.type == "compound_statement" and _is_only_read(word, declarator, scope, view)


def _is_only_read(word: str, declarator: Node, scope: Node, view: FileView) -> bool:
    """Return whether a local variable is never used but to read its text."""
    written = word.encode()
    uses = word_places(written, view, declarator.end_byte, scope.end_byte)
    return all(view.code.startswith(_READS, at + len(written)) for at in uses)


def _of_macro(word: str, view: FileView) -> str | None:
    """Return the text of a macro that the file defines once, as one literal or several in a row."""
    found = re.findall(
        rb"^[ \t]*#[ \t]*define[ \t]+" + re.escape(word.encode()) + rb"\b([^\n]*)$", view.content, re.MULTILINE
    )
    if len(found) != 1 or (b"#undef" in view.content and word.encode() in view.content.partition(b"#undef")[2]):
        return None
    match = re.fullmatch(rb'[ \t]+((?:"(?:[^"\\\n]|\\.)*"[ \t]*)+)(?://.*|/\*.*\*/[ \t]*)?\r?', found[0])
    return "".join(re.findall(r'"((?:[^"\\]|\\.)*)"', match[1].decode("utf-8", "replace"))) if match else None
