"""Source as coloured pieces: comments, texts, numbers, words of the language, what is defined.

One expression for each language goes over the whole text once. It knows where comments and texts end and which words
mean something, no grammar: a page of ten thousand lines has to come at once.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence

import msgspec

Piece = tuple[str, str]
"""Class of a piece of source (empty for none) and its text, not yet escaped.

``c`` is a comment, ``s`` a text, ``m`` a number, ``k`` a keyword, ``t`` a type or what the language brings along,
``f`` a name that is defined here, ``p`` what is not of the language itself: a line of the preprocessor, a decorator.
"""

Context = Callable[[str, int, int], str]
"""Gives the class of a word that is none of the language's, by the whole text and where the word begins and ends."""


def _no_context(text: str, start: int, end: int) -> str:  # noqa: ARG001 - the shape of every context
    return ""


class _Grammar(msgspec.Struct, frozen=True):
    """How a language is read: groups of ``pattern`` are named by class; ``word`` is looked up in ``words``."""

    pattern: re.Pattern[str]
    words: Mapping[str, str] = {}
    context: Context = _no_context


def colour(lines: Sequence[str], language: str) -> list[tuple[Piece, ...]]:
    """Return each line as coloured pieces; plain where the language is not known."""
    grammar = _GRAMMARS.get(language)
    if grammar is None:
        return [(("", line),) if line else () for line in lines]
    text = "\n".join(lines)
    coloured: list[list[Piece]] = [[]]
    at = 0
    for start, end, name in _found(grammar, text):
        if start > at:
            _append(coloured, "", text[at:start])
        _append(coloured, name, text[start:end])
        at = end
    _append(coloured, "", text[at:])
    return [tuple(line) for line in coloured[: len(lines)]]


def _append(coloured: list[list[Piece]], name: str, text: str) -> None:
    if "\n" not in text:
        if text:
            coloured[-1].append((name, text))
        return
    first, *others = text.split("\n")
    if first:
        coloured[-1].append((name, first))
    coloured.extend([(name, other)] if other else [] for other in others)


def _found(grammar: _Grammar, text: str) -> Iterator[tuple[int, int, str]]:
    words, context = grammar.words, grammar.context
    for match in grammar.pattern.finditer(text):
        name = match.lastgroup or ""
        start, end = match.span()
        if name == "word":
            name = words.get(match.group(), "") or context(text, start, end)
            if not name:
                continue
        yield start, end, name


def _words(**named: str) -> dict[str, str]:
    return {word: name for name, text in named.items() for word in text.split()}


_CPP_WORDS = _words(
    k="""
    alignas alignof and and_eq asm auto bitand bitor break case catch class co_await co_return co_yield compl concept
    const const_cast consteval constexpr constinit continue decltype default delete do dynamic_cast else enum explicit
    export extern final for friend goto if inline mutable namespace new noexcept not not_eq operator or or_eq
    override private protected public register reinterpret_cast requires restrict return sizeof static static_assert
    static_cast struct switch template this thread_local throw try typedef typeid typename union using virtual volatile
    while xor xor_eq""",
    t="""
    bool char char16_t char32_t char8_t double float int int16_t int32_t int64_t int8_t long ptrdiff_t short signed
    size_t ssize_t uint16_t uint32_t uint64_t uint8_t uintptr_t unsigned void wchar_t true false nullptr
    NULL""",
)
_CPP = re.compile(
    r"""
    (?P<p>(?m:^)[ \t]*\#(?:[^/\\\n"']|\\[\s\S]|/(?![/*])|"(?:[^"\\\n]|\\[\s\S])*"|["'])*)
    |(?P<s>(?:u8|[LuU])?R"(?P<fence>[^\s()\\]{0,16})\([\s\S]*?(?:\)(?P=fence)"|\Z)
        |(?:u8|[LuU])?"(?:[^"\\\n]|\\[\s\S])*"?|(?:u8|[LuU])?'(?:[^'\\\n]|\\[\s\S])*'?)
    |(?P<word>[A-Za-z_]\w*)
    |(?P<c>//(?:[^\\\n]|\\[\s\S])*|/\*[\s\S]*?(?:\*/|\Z))
    |(?P<m>\.?\d(?:[eEpP][+-]|'(?=[\da-fA-F])|[\w.])*)
    """,
    re.VERBOSE,
)
_CPP_DECLARES = re.compile(r"[\w:<>,&*~\[\] \t]*[ \t&*:~]")
_CPP_NO_TYPE = re.compile(
    r"\s*(?:return|else|throw|new|delete|case|goto|co_return|co_await|co_yield|if|while|for|\w+,)\b"
)
_CPP_OF_TYPE = re.compile(r"\b(?:class|struct|union|enum)[ \t]+$")


def _cpp_context(text: str, start: int, end: int) -> str:
    """Return whether the word is a function or class that is declared here."""
    begin = text.rfind("\n", 0, start) + 1
    if text.startswith("(", end):
        return "f" if _declares(text[begin:start]) else ""
    is_type = text[start - 1 : start] in (" ", "\t") and _CPP_OF_TYPE.search(text, begin, start)
    return "f" if is_type else ""


def _declares(head: str) -> bool:
    """Return whether what stands in the line before a name and its parameters makes it a declaration.

    A type does, or a class; deeper in the text a class alone is as likely a call.
    """
    if not _CPP_DECLARES.fullmatch(head) or _CPP_NO_TYPE.match(head):
        return False
    outermost = head[0] not in " \t" or not head.endswith(":")
    return len(head.split()) > 1 or (outermost and bool(head.strip(" \t:~&*")))


_PYTHON_WORDS = _words(
    k="""
    False None True and as assert async await break class continue def del elif else except finally for from global if
    import in is lambda nonlocal not or pass raise return try while with yield""",
    t="""
    abs all any bool bytearray bytes callable chr classmethod cls compile complex delattr dict dir divmod enumerate eval
    exec filter float format frozenset getattr globals hasattr hash hex id input int isinstance issubclass iter len list
    locals map max memoryview min next object oct open ord pow print property range repr reversed round self set setattr
    slice sorted staticmethod str sum super tuple type unicode vars xrange zip""",
)
_PYTHON = re.compile(
    r"""
    (?P<s>(?<![\w])[bBfFrRuU]{0,2}(?:\"\"\"(?:[^\\]|\\[\s\S])*?(?:\"\"\"|\Z)|'''(?:[^\\]|\\[\s\S])*?(?:'''|\Z)
        |"(?:[^"\\\n]|\\[\s\S])*"?|'(?:[^'\\\n]|\\[\s\S])*'?))
    |(?P<word>\.?[^\W\d]\w*)
    |(?P<c>\#[^\n]*)
    |(?P<m>\.?\d(?:[eE][+-]|[\w.])*)
    |(?P<p>(?m:^)[ \t]*@[ \t]*[^\W\d][\w.]*)
    """,
    re.VERBOSE,
)


def _python_context(text: str, start: int, end: int) -> str:  # noqa: ARG001 - the shape of every context
    """Return whether the word is a function or class that is defined here."""
    return "f" if text[max(0, start - 4) : start] == "def " or text[max(0, start - 6) : start] == "class " else ""


_CMAKE = re.compile(
    r"""
    (?P<c>\#\[(?P<level>=*)\[[\s\S]*?(?:\](?P=level)\]|\Z)|\#[^\n]*)
    |(?P<t>[A-Za-z_]\w*(?=[ \t]*\())
    |(?P<s>"(?:[^"\\]|\\[\s\S])*"?|\[(?P<deep>=*)\[[\s\S]*?\](?P=deep)\]|(?:[^\s\#"()$\\]|\\.)+)
    |(?P<word>[$]\w*\{[^\s}]*\}?)
    """,
    re.VERBOSE,
)
_XML = re.compile(
    r"""
    (?P<c><!--[\s\S]*?(?:-->|\Z))
    |(?P<p><[?][\s\S]*?(?:[?]>|\Z)|<!\[CDATA\[[\s\S]*?(?:\]\]>|\Z)|<![^>]*>?)
    |(?P<k></?[\w.:-]+>?|/?>)
    |(?P<t>(?<=\s)[\w.:-]+[ \t]*=)
    |(?P<s>(?<==)[ \t]*(?:"[^"]*"?|'[^']*'?))
    """,
    re.VERBOSE,
)
_YAML = re.compile(
    r"""
    (?P<k>(?:(?m:^)|(?<=[\s{,]))
        (?:"(?:[^"\\\n]|\\.)*"|'[^'\n]*'|[^\s\#"'{}\[\],&*!|>%@-][^\n\#{}\[\],"':]*?)[ \t]*
        (?=:(?:\s|\Z)))
    |(?P<s>"(?:[^"\\\n]|\\.)*"?|(?<=[\s\[{,])'(?:[^'\n]|'')*'?)
    |(?P<c>(?:(?m:^)|(?<=\s))\#[^\n]*)
    |(?P<word>[^\s\#"',\[\]{}]+)
    """,
    re.VERBOSE,
)


_LIKE_CPP = _Grammar(_CPP, _CPP_WORDS, _cpp_context)
_LIKE_PYTHON = _Grammar(_PYTHON, _PYTHON_WORDS, _python_context)
_LIKE_CMAKE = _Grammar(_CMAKE)
_LIKE_XML = _Grammar(_XML)
_LIKE_YAML = _Grammar(_YAML)
_GRAMMARS = {
    "c": _LIKE_CPP,
    "cpp": _LIKE_CPP,
    "python": _LIKE_PYTHON,
    "launch_python": _LIKE_PYTHON,
    "cmake": _LIKE_CMAKE,
    "manifest": _LIKE_XML,
    "launch_xml": _LIKE_XML,
    "xml": _LIKE_XML,
    "urdf": _LIKE_XML,
    "xacro": _LIKE_XML,
    "launch_yaml": _LIKE_YAML,
    "yaml": _LIKE_YAML,
}
