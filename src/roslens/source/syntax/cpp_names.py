"""Names, parameters and declarators of C++."""

from __future__ import annotations

import re
from functools import lru_cache

import msgspec
from tree_sitter import Node

_ANGLES = re.compile(r"<[^<>]*>")
_SPACE = re.compile(r"\s+")
_AROUND_MARKS = re.compile(r"\s*(::|[<>,*&()\[\]])\s*")
_NAME_IN_DECLARATOR = re.compile(r"\b(?!const\b|volatile\b|restrict\b)[A-Za-z_]\w*")
_LONGEST = 4000
_OPERATOR = re.compile(r"\boperator\b")
_MACRO = re.compile(r"[A-Z][A-Z0-9_]+")
_WITH_DEFAULT = "optional_parameter_declaration"
_PARAMETERS = ("parameter_declaration", _WITH_DEFAULT, "variadic_parameter_declaration")


class Declarator(msgspec.Struct, frozen=True):
    """The content of a function's declarator: its name, the scope written before it, and its parameters.

    ``macro`` tells that it looks like a macro such as TEST, ``pointer`` that it declares a pointer to a function.
    """

    name: str
    scope: str
    parameters: int
    signature: str
    start: int
    end: int
    macro: bool = False
    pointer: bool = False


def text_of(source: bytes) -> str:
    """Return bytes of a name as text; what is no UTF-8 is replaced."""
    return source.decode("utf-8", "replace")


def without_arguments(name: str) -> str:
    """Return ``name`` without template arguments and white space: ``a::B<C<int> >::d`` becomes ``a::B::d``."""
    while "<" in name:
        shorter = _ANGLES.sub("", name)
        if shorter == name:
            break
        name = shorter
    return "".join(name.split())


@lru_cache(maxsize=4096)
def split_name(written: str) -> tuple[str, str]:
    """Return the scope and the name of a function as it is written before its parameters."""
    if written.isidentifier():
        return "", written
    operator = _OPERATOR.search(written) if "operator" in written else None
    head, tail = (written[: operator.start()], written[operator.start() :]) if operator else (written, "")
    plain = without_arguments(head)
    if tail:
        return plain.removesuffix("::").removeprefix("::"), _squeezed_operator(tail)
    scope, _, name = plain.rpartition("::")
    return scope.removeprefix("::"), name


def _squeezed_operator(written: str) -> str:
    rest = _SPACE.sub(" ", written.removeprefix("operator")).strip()
    return f"operator {rest}" if rest[:1].isalpha() or rest[:1] == "_" else f"operator{rest.replace(' ', '')}"


def squeezed(text: str) -> str:
    """Return a type with single spaces between words and none around marks."""
    return _AROUND_MARKS.sub(r"\1", _SPACE.sub(" ", text)).strip()


def function_declarator(node: Node) -> Node | None:
    """Return the declarator that holds the parameters of a function, the innermost where functions return functions."""
    found = None
    current: Node | None = node
    for _ in range(50):
        if current is None:
            break
        kind = current.type
        if kind in _PLAIN_NAMES:
            break
        if kind in ("function_declarator", "abstract_function_declarator"):
            found = current
        inner = current.child_by_field_name("declarator")
        if inner is None and kind == "qualified_identifier":
            inner = current.child_by_field_name("name")
        if inner is None and kind in _WRAPPERS:
            inner = next(
                (child for child in current.named_children if child.type.endswith(("declarator", "cast"))), None
            )
        current = inner
    return found


_PLAIN_NAMES = frozenset({"identifier", "field_identifier", "destructor_name", "operator_name"})
_WRAPPERS = ("reference_declarator", "parenthesized_declarator", "pointer_declarator", "attributed_declarator")


def read_declarator(definition: Node, source: bytes, class_name: str = "") -> Declarator:
    """Read the declarator of a function definition or declaration.

    Args:
        definition: its node.
        source: the bytes that were parsed.
        class_name: of the class that it stands in, which its constructors have too.
    """
    outer = definition.child_by_field_name("declarator")
    declarator = function_declarator(outer) if outer is not None else None
    parameters = declarator.child_by_field_name("parameters") if declarator is not None else None
    if outer is None or declarator is None or parameters is None:
        start, end = definition.byte_range
        return Declarator("", "", 0, "", start, min(end, start + 1))
    start = declarator.start_byte
    if declarator.type == "abstract_function_declarator":
        cast = outer
        while cast.type in _WRAPPERS:
            cast = cast.named_children[-1]
        start = cast.start_byte
    opening, end = parameters.byte_range
    written = text_of(source[start : min(opening, start + _LONGEST)])
    scope, name = split_name(written)
    types = [type_ for node in parameters.named_children if (type_ := _type_of(node, source))]
    variadic = b"..." in source[max(opening, end - 8) : end]
    if variadic and not (types and "..." in types[-1]):
        types.append("...")
    if types == ["void"]:
        types = []
    untyped = definition.child_by_field_name("type") is None
    if types and not scope and name != class_name and _MACRO.fullmatch(name) and untyped:
        return Declarator(f"{name}({','.join(types)})", "", 0, "", start, end, macro=True)
    pointer = "*" in name and not name.startswith("operator")
    return Declarator(name, scope, len(types), ", ".join(types), start, end, pointer=pointer)


def _type_of(parameter: Node, source: bytes) -> str:
    kind = parameter.type
    if kind not in _PARAMETERS:
        return ""
    start, end = parameter.byte_range
    if kind == _WITH_DEFAULT:
        default = parameter.child_by_field_name("default_value")
        if default is not None:
            end = default.start_byte
    declarator = parameter.child_by_field_name("declarator")
    if declarator is None:
        return _parameter_type(source[start : min(end, start + _LONGEST)], b"")
    middle, end = declarator.byte_range
    return _parameter_type(source[start : min(middle, start + _LONGEST)], source[middle : min(end, middle + _LONGEST)])


def _parameter_type(before: bytes, declarator: bytes) -> str:
    """Return the type of a parameter, given what stands before its declarator and the declarator."""
    return _type_text(before, _without_name(declarator))


@lru_cache(maxsize=4096)
def _without_name(declarator: bytes) -> str:
    return _NAME_IN_DECLARATOR.sub("", text_of(declarator), count=1)


@lru_cache(maxsize=4096)
def _type_text(before: bytes, behind: str) -> str:
    """Return a type from what stands before and behind the name: there are far fewer types than names."""
    return squeezed(f"{text_of(before)} {behind}".rstrip("= \t\r\n"))


def base_names(definition: Node, source: bytes) -> tuple[str, ...]:
    """Return the names of the bases of a class, without template arguments."""
    clause = next((child for child in definition.named_children if child.type == "base_class_clause"), None)
    if clause is None:
        return ()
    return tuple(
        without_arguments(text_of(source[node.start_byte : node.end_byte]))
        for node in clause.named_children
        if node.type in ("type_identifier", "qualified_identifier", "template_type")
    )


@lru_cache(maxsize=1024)
def scope_within(prefix: str, scope: str) -> str:
    """Return ``scope`` as seen from ``prefix``: inside ``a::b`` both ``a::b::C`` and ``b::C`` are ``C``."""
    around, written = prefix.split("::"), scope.split("::")
    for count in range(min(len(around), len(written)), 0, -1):
        if around[-count:] == written[:count]:
            return "::".join(written[count:])
    return scope


def friend_name(declaration: Node, source: bytes) -> str:
    """Return the class or function that a friend declaration names, empty where it names none."""
    for child in declaration.named_children:
        if child.type in ("function_definition", "declaration"):
            declarator = read_declarator(child, source)
            return "::".join(part for part in (declarator.scope, declarator.name) if part)
        if child.type in _CLASS_NAMES:
            name = child.child_by_field_name("name") or child
            return without_arguments(text_of(source[name.start_byte : name.end_byte])).removeprefix("::")
    return ""


_CLASS_NAMES = ("type_identifier", "qualified_identifier", "template_type", "class_specifier", "struct_specifier")


def callee_name(written: str) -> str:
    """Return what a call names, without receiver and template arguments; empty for a computed callee."""
    if "<" in written:
        written = without_arguments(written)
    for mark in ("->", "."):
        written = written.rpartition(mark)[2]
    written = "".join(written.split()).removeprefix("::")
    return written if _CALLEE.fullmatch(written) else ""


_CALLEE = re.compile(r"~?[A-Za-z_]\w*(?:::~?[A-Za-z_]\w*)*")
