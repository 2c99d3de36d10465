"""Types, names and declarators of C++, interpreted from their text: there are far fewer of them than places."""

from __future__ import annotations

import re
from functools import lru_cache

from tree_sitter import Node

from roslens.source.syntax.cpp_names import squeezed, text_of, without_arguments

_STORAGE = re.compile(
    r"\b(?:static|constexpr|constinit|inline|extern|mutable|thread_local|register|typename|struct|class|enum|explicit"
    r"|virtual|template)\b"
)
_KEYWORD = re.compile(r"\b(?:typename|template|struct|class|enum|const|volatile)\b")
_DEDUCED = re.compile(r"\b(?:auto|decltype)\b")
_ATTRIBUTE = re.compile(r"\[\[.*?\]\]", re.DOTALL)
_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
_NAME = re.compile(r"~?[A-Za-z_]\w*(?:\s*::\s*~?[A-Za-z_]\w*)*")
_MODIFIERS = re.compile(r"\b(?:const|volatile|restrict|__restrict)\b")
_POINTED = re.compile(r"\(\s*(?:[\w:]+::)?[*&]+\s*(\w+)")
_PRIMITIVE = re.compile(
    r"(?:const )?(?:(?:unsigned|signed|long|short|int|char|bool|float|double|void)(?: (?!$)|$))+|(?:std::)?size_t"
    r"|(?:std::)?u?int(?:8|16|32|64)_t"
)
_SCOPE = re.compile(r"[\w:<>,\s]*::\s*")
_SIMPLE = re.compile(r"\s*[\w:]*(?:::\w+|_\w*|[^\W_a-z]\w*)\s*")
"""A scoped name, or one with a capital or an underscore: no keyword."""
_PLAIN = re.compile(rb"\w*")
_OPENING, _CLOSING = "<([{", ">)]}"
_LONGEST = 2000


def dotted(written: str) -> str:
    """Return a name with its scope joined by dots: ``::a :: B`` is ``a.B``."""
    if "::" not in written:
        return written.strip()
    return "".join(written.split()).removeprefix("::").replace("::", ".")


@lru_cache(maxsize=8192)
def name_and_templates(written: bytes) -> tuple[str, tuple[str, ...]]:
    """Return a dotted name without template arguments, and the last template arguments in it."""
    text = text_of(written[:_LONGEST])
    if "//" in text or "/*" in text:
        text = _COMMENT.sub(" ", text)
    if "<" not in text or "operator" in text:
        return dotted(_KEYWORD.sub("", text)), ()
    return dotted(without_arguments(_KEYWORD.sub("", text))), _template_arguments(text)


def _template_arguments(text: str) -> tuple[str, ...]:
    end = text.rfind(">")
    depth, start = 0, end
    while start >= 0:
        depth += (text[start] == ">") - (text[start] == "<")
        if depth <= 0:
            break
        start -= 1
    return tuple(map(squeezed, split_at_commas(text[start + 1 : end]))) if start >= 0 else ()


def specialised_for(declarator: Node, source: bytes) -> tuple[str, ...]:
    """Return the template arguments of the name of a function that is a specialisation; empty of another."""
    named = declarator.child_by_field_name("declarator")
    while named is not None and named.type == "qualified_identifier":
        named = named.child_by_field_name("name")
    if named is None or named.type not in ("template_function", "template_method"):
        return ()
    return name_and_templates(source[named.start_byte : named.end_byte])[1]


def split_at_commas(text: str) -> list[str]:
    """Return the parts between commas that stand in no brackets."""
    parts, depth, start = [], 0, 0
    for place, mark in enumerate(text):
        if mark == "," and depth == 0:
            parts.append(text[start:place])
            start = place + 1
        elif mark in _OPENING:
            depth += 1
        elif mark in _CLOSING:
            depth -= 1
    rest = text[start:]
    return [*parts, rest] if rest.strip() or parts else []


def declared_type(before: bytes, declarator: bytes = b"") -> str:
    """Return a declared type as written: what stands before a declarator, and the marks of the declarator itself.

    Storage classes are no part of it, and what the compiler deduces (``auto``) is empty.
    """
    return _type(before, b"" if _PLAIN.fullmatch(declarator) else declarator)


@lru_cache(maxsize=8192)
def _type(before: bytes, declarator: bytes) -> str:
    text = text_of(before[:_LONGEST])
    if _DEDUCED.search(text):
        return ""
    if "/" in text:
        text = _COMMENT.sub(" ", text)
    if "[[" in text:
        text = _ATTRIBUTE.sub("", text)
    if not declarator and _SIMPLE.fullmatch(text):
        return text.strip()
    text = _STORAGE.sub("", text)
    marks = text_of(declarator[:_LONGEST])
    if "::" in marks and "(" not in marks:
        marks = _SCOPE.sub("", marks)
    if marks:
        marks = _NAME.sub(_only_modifiers, marks)
    return squeezed(f"{text} {marks}".rstrip("= \t\r\n"))


def _only_modifiers(match: re.Match[str]) -> str:
    return match[0] if _MODIFIERS.fullmatch(match[0]) else ""


@lru_cache(maxsize=8192)
def declared_name(declarator: bytes) -> str:
    """Return the dotted name that a declarator declares: ``*a[3]`` is ``a``, ``(*f)(int)`` is ``f``; empty of none."""
    text = text_of(declarator[:_LONGEST])
    if text.isidentifier():
        return text
    if "/" in text:
        text = _COMMENT.sub(" ", text)
    pointed = _POINTED.search(text)
    if pointed:
        return pointed[1]
    plain = without_arguments(_MODIFIERS.sub(" ", text.partition("[")[0]).replace("*", " ").replace("&", " "))
    found = _NAME.findall(plain)
    return dotted(found[-1]) if found else ""


@lru_cache(maxsize=4096)
def is_primitive(type_: bytes) -> bool:
    """Return whether a type is a number, character or truth value: to construct one is a cast."""
    return _PRIMITIVE.fullmatch(squeezed(text_of(type_[:80]))) is not None
