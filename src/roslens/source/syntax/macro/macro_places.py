"""Places of macros: the text around a name in capitals that distinguishes it from a type, a constant or a call."""

from __future__ import annotations

import re
from typing import NamedTuple

CAPS = rb"[A-Z_][A-Z0-9_]{2,}\b"
"""A name in capitals."""
MACRO = re.compile(
    rb"(?<![\w.:])(?:" + CAPS + rb"|\w*_(?:inline|constexpr\d*|noexcept|nodiscard|override|final|export|deprecated)\b)"
)
"""What may be a macro: a name in capitals, or one that ends like a word of the language."""
_KEYWORDS = (
    rb"(?:static|inline|virtual|explicit|constexpr|unsigned|signed|void|int|float|double|bool|char|short|long|auto"
    rb"|typename|template|struct|class|enum|union|extern|mutable|friend|operator|using|typedef|namespace)\b"
)
_NAME = rb"(?:::)?[A-Za-z_][\w:]*(?:<[^;{}()]{0,200}?>(?:::\w+)*)?"
NO_TYPES = frozenset(
    b"static const virtual inline extern constexpr friend typedef unsigned signed return else new case struct class "
    b"enum union typename mutable volatile public private protected goto using namespace delete throw do".split()
)
"""Words before which no name of a type ends: what follows may be one."""


class MacroKind(NamedTuple):
    """Where a macro of a kind stands: what is before it and behind it.

    Attributes:
        before: a pattern that ends where the macro begins; its group is a word that must not be a keyword.
        behind: a pattern that begins where the macro or its arguments end.
        given: whether it must have arguments.
        everywhere: whether what it tells of a name holds for the name in the whole file.
        a_type: whether it stands for a type: its arguments alone are taken away.
        name_only: whether what follows are the arguments of another name.
    """

    before: re.Pattern[bytes] | None
    behind: re.Pattern[bytes]
    given: bool = False
    everywhere: bool = True
    a_type: bool = False
    name_only: bool = False


BEHIND_PARAMETERS = MacroKind(
    re.compile(rb"\)\s*(?:(?:const|volatile|override|noexcept|final)\b\s*)*\Z"),
    re.compile(rb"\s*(?:[;{=]|:(?!:)|->|(?:const|override|final|noexcept)\b|" + CAPS + rb")"),
)
GOES_ON = rb"\s*[;{+*/.,?:)=&|<>\[(-]"
"""What lets an expression or statement go on behind a name or its arguments."""
KINDS = (
    BEHIND_PARAMETERS,
    MacroKind(re.compile(rb"\b(?:class|struct)\s+[\w:]+(?:<[^;{}]{0,99}?>)?\s+\Z"), re.compile(rb"\s*[:{]")),
    MacroKind(re.compile(rb"\b(?:class|struct)\s+\Z"), re.compile(rb"\s+\w+"), given=True),
    MacroKind(re.compile(rb"\}\s*\Z"), re.compile(rb"\s+\w+\s*;")),
    MacroKind(re.compile(rb"\]\s*\Z"), re.compile(rb"\s*[=;,]")),
    MacroKind(re.compile(rb"\(\s*\Z"), re.compile(rb"\s+[\w:]+\s*[*&]+\s*\)")),
    MacroKind(re.compile(rb"(?:[=(,!&|<>+*/-]\s*|\breturn\s+)\Z"), re.compile(rb"\s+\w+\s*[(:]")),
    MacroKind(
        re.compile(rb"([\w>*&]+)\s+(?!(?:const|volatile|unsigned|long|short|int|char|double|float|bool)\b)\w+\s+\Z"),
        re.compile(rb"\s*[;=]"),
    ),
    MacroKind(re.compile(rb"\*\s*\Z"), re.compile(rb"\s+\w+\s*[,)=;(\[]")),
    MacroKind(re.compile(rb"(?:[=(,!&|<>+*/-]\s*|\breturn\s+)\w+\s+\Z"), re.compile(rb""), given=True, name_only=True),
    MacroKind(re.compile(rb"\btypedef\b[^;{}()]{1,150}\(\s*\Z"), re.compile(rb"\s*\*?\s*\w+\s*\)")),
    MacroKind(re.compile(rb"\b(?:static|const|extern)\s+\Z"), re.compile(rb"\s*;"), given=True, a_type=True),
    MacroKind(re.compile(rb"\btypedef\b[^;{}]{1,150}\w\s+\Z"), re.compile(rb"\s*;")),
    MacroKind(
        None,
        re.compile(rb"\s+(?:operator\b|(?:const\s+)?[*&]*\w+\s*[;,)(={\[])|\s*(?:::|[>&*])"),
        given=True,
        a_type=True,
    ),
    MacroKind(None, re.compile(rb"\s+" + _KEYWORDS)),
    MacroKind(
        None,
        re.compile(
            rb"\s+(?:(?:\w+::)*(\w+)(?:<[^;{}()]{0,200}>)?::~?\1\s*\("
            rb"|\w+\s*\((?:[^()]|\([^()]{0,300}\)){0,300}\)\s*(?:noexcept\s*)?:\s*\w+\s*[({])"
        ),
    ),
    MacroKind(re.compile(rb"([\w>*&]+)\s+\Z"), re.compile(rb"\s+[\w:~]+\s*[(=;\[]")),
    MacroKind(
        None,
        re.compile(
            rb"\s+(?!(?:volatile|operator|and|or|not)\b|const\s+\w+\s*[(;={,\[):]|const\s*[*&])(?:const\s+)?"
            + _NAME
            + rb"(?:\s+const)?(?:\s*[*&]+\s*|\s+)(?:const\s+)?(?:"
            + _NAME
            + rb"|operator\b[^;{}]{1,10}?)\s*[(;={,\[):]"
        ),
    ),
    MacroKind(re.compile(rb"([\w>*&]+)\s+\w+\s+\Z"), re.compile(rb"\s*[;,)={]"), given=True),
    MacroKind(
        re.compile(rb"(?:\A|\n)[ \t]*\Z"),
        re.compile(rb"[ \t]*\r?(?:\n(?!" + GOES_ON + rb")|\Z)"),
        everywhere=False,
    ),
    MacroKind(re.compile(rb"[;}]\s*\Z"), re.compile(rb"\s*\}"), everywhere=False),
)
"""Each is tried by itself, in this order."""
