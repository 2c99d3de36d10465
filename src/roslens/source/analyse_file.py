"""One file from bytes to facts: what the cache keeps."""

from __future__ import annotations

from functools import cache

import msgspec

from roslens.model.failure import Failure
from roslens.model.source import Language
from roslens.source.settings import MacroSettings
from roslens.source.syntax.facts import FileFacts
from roslens.source.syntax.macros import MacroPreset, load_macros
from roslens.source.workspace.encoding import encoding_failure
from roslens.source.workspace.suppress import Suppression, suppressions


class FileAnalysis(msgspec.Struct, frozen=True, array_like=True):
    """The facts of a file, the findings its author asked to leave out, and what is wrong with its bytes.

    It is kept by content: the failure names no file.
    """

    facts: FileFacts
    suppressions: tuple[Suppression, ...] = ()
    encoding: Failure | None = None


_preset = cache(load_macros)


def macro_preset(settings: MacroSettings) -> MacroPreset:
    """Return the macros to blank, compiled once per process and settings."""
    return _preset(settings)


def analyse_file(content: bytes, language: Language, macros: MacroSettings) -> FileAnalysis:
    """Parse ``content`` once and take its facts.

    Raises:
        ValueError: the language has no syntax.
    """
    syntax = language.parsed_as
    if syntax == "cpp":
        from roslens.source.syntax.cpp import parse_cpp

        facts = parse_cpp(content, macro_preset(macros))
    elif syntax == "python":
        from roslens.source.syntax.python import parse_python

        facts = parse_python(content)
    else:
        raise ValueError(f"{language.value!r} has no syntax; expected C, C++ or Python")
    return FileAnalysis(facts, suppressions(content), encoding_failure("", content))
