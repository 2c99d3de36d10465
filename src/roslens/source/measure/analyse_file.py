"""One file from bytes to facts: what the cache keeps."""

from __future__ import annotations

import msgspec

from roslens.model.failure import Failure
from roslens.model.source import Language
from roslens.source.parsed_file import ParsedFile, parse_file
from roslens.source.rules.callbacks import callbacks_of
from roslens.source.rules.cpp_flow.member_facts import member_facts
from roslens.source.rules.flow.python_reached import reached_facts
from roslens.source.rules.match_file import Matched, kinds_asked, match_file
from roslens.source.settings import MacroSettings
from roslens.source.syntax.facts import FileFacts
from roslens.source.workspace.encoding import encoding_failure
from roslens.source.workspace.suppress import Suppression, suppressions


class FileAnalysis(msgspec.Struct, frozen=True, array_like=True):
    """The facts of a file, the findings its author asked to leave out, what is wrong with its bytes, what rules found.

    ``callbacks`` are the functions that it registers, and the members that its classes declare
    (:mod:`~roslens.source.rules.cpp_flow.member_facts`); a rule on another file may need to know.

    It is kept by content: the failure names no file.
    """

    facts: FileFacts
    suppressions: tuple[Suppression, ...] = ()
    encoding: Failure | None = None
    matched: Matched = Matched()
    callbacks: tuple[str, ...] = ()


def analyse_file(content: bytes, language: Language, macros: MacroSettings) -> FileAnalysis:
    """Parse ``content`` once and take its facts.

    Raises:
        ValueError: the language has no syntax.
    """
    return analyse_parsed(content, parse_file(content, language, macros))


def analyse_parsed(content: bytes, parsed: ParsedFile, wanted: frozenset[str] | None = None) -> FileAnalysis:
    """Take the facts of what was parsed already; ``wanted`` are the rules that look at it, all for None."""
    facts = parsed.facts(kinds_asked(parsed.syntax, wanted))
    view = parsed.view()
    return FileAnalysis(
        facts,
        suppressions(content),
        encoding_failure("", content),
        match_file(view, wanted),
        (*callbacks_of(view), *member_facts(view), *reached_facts(view)),
    )
