"""The flags of a compiler that shape what code means, and so are taken from a workspace; every other is left out.

An allow-list: a compiler's driver has hundreds of flags, and among them some that start programs of the workspace
(``--amdgpu-arch-tool=``, ``-B``, ``-fplugin=``, ``-specs=``), read more flags from files (``@file``, ``--config``) or
write files (``-MF``, ``--serialize-diagnostics``, ``-Xclang -header-include-file``). What is not known is left out.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import PurePosixPath

_JOINED = re.compile(
    r"""
    -(?:I|isystem|iquote|idirafter|isysroot|D|U).+     # a value that follows at once
    | --sysroot=.+
    | -std=[\w+:]+
    | -x(?:c|c\+\+)(?:-header)?
    | -stdlib=(?:libc\+\+|libstdc\+\+)
    | -nostdinc(?:\+\+)? | -nostdlibinc | -undef | -ansi | -pthread | -pedantic(?:-errors)? | -w
    | -O[0-3sgz]? | -Ofast
    | -W(?:[a-z0-9][\w+-]*(?:=[\w+-]+)?)?            # a warning; -Wp, -Wl, and -Wa, hand words on to other programs
    | -m(?:32|64|x32) | -m(?:arch|cpu|tune)=[\w.+-]+ | -m(?:no-)?(?:sse|avx|fma|aes|popcnt|bmi)[\w.]*
    | --target=[\w.-]+
    | -f(?:no-)?(?:rtti|exceptions|permissive|signed-char|unsigned-char|short-enums|short-wchar|openmp|coroutines
        |concepts|char8_t|modules-ts|strict-aliasing|strict-overflow|wrapv|fast-math|math-errno|builtin|threadsafe-statics
        |aligned-new|sized-deallocation|access-control|elide-constructors|common|freestanding|hosted|blocks
        |ms-extensions|gnu-keywords|operator-names|delayed-template-parsing|lax-vector-conversions|stack-protector
        |pic|PIC|pie|PIE)
    | -ftemplate-depth=\d+ | -fconstexpr-(?:depth|steps)=\d+
    | -fvisibility=(?:default|hidden|internal|protected) | -fvisibility-inlines-hidden
    | -ffreestanding
    """,
    re.VERBOSE,
)
_WITH_VALUE = frozenset(
    {"-I", "-isystem", "-iquote", "-idirafter", "-isysroot", "--sysroot", "-D", "-U", "-include", "-imacros"}
)
"""Flags whose value is the next word."""

_LANGUAGES = frozenset({"c", "c++", "c-header", "c++-header"})
_HANDED_ON = re.compile(r"-W[a-z],")
_TARGETS = re.compile(r"amdgcn|nvptx|spirv|spir", re.IGNORECASE)
"""Targets whose driver looks for the processor by a program."""


def allowed_flags(words: Sequence[str]) -> Iterator[str]:
    """Yield the words of a command, without its program and its files, that only shape what code means."""
    at = 0
    while at < len(words):
        word, value = words[at], words[at + 1] if at + 1 < len(words) else ""
        if word in _WITH_VALUE or (word == "-x" and value in _LANGUAGES):
            # A value that looks like a flag is one: the compiler would take it in the place of a value, but then it is
            # no folder and no name.
            if value and not value.startswith(("-", "@")):
                yield from (word, value)
            at += 2
            continue
        if is_allowed(word):
            yield word
        at += 1


def is_allowed(word: str) -> bool:
    """Return whether a flag of one word only shapes what code means."""
    return bool(_JOINED.fullmatch(word)) and not _HANDED_ON.match(word) and not _TARGETS.search(word.partition("=")[2])


def compiler_of(program: str, file: str) -> str:
    """Return the compiler whose flags a command has, by name alone: beside one by path lie settings of its own."""
    is_cpp = "++" in PurePosixPath(program).name or PurePosixPath(file).suffix.lower() not in {".c", ".h"}
    return "clang++" if is_cpp else "clang"
