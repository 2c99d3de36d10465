"""One file from bytes to facts: what the cache keeps."""

from __future__ import annotations

import msgspec

from roslens.model.failure import Failure
from roslens.model.source import Language
from roslens.source.parsed_file import ParsedFile, parse_file
from roslens.source.settings import MacroSettings
from roslens.source.syntax.facts import FileFacts
from roslens.source.workspace.encoding import encoding_failure
from roslens.source.workspace.suppress import Suppression, suppressions


class FileAnalysis(msgspec.Struct, frozen=True, array_like=True):
    """The facts of a file, the findings its author asked to leave out, and what is wrong with its bytes.

    It is kept by content: the failure names no file.
    """

    facts: FileFacts
    suppressions: tuple[Suppression, ...] = ()
    encoding: Failure | None = None


def analyse_file(content: bytes, language: Language, macros: MacroSettings) -> FileAnalysis:
    """Parse ``content`` once and take its facts.

    Raises:
        ValueError: the language has no syntax.
    """
    return analyse_parsed(content, parse_file(content, language, macros))


def analyse_parsed(content: bytes, parsed: ParsedFile) -> FileAnalysis:
    """Take the facts of what was parsed already."""
    return FileAnalysis(parsed.facts(), suppressions(content), encoding_failure("", content))
