"""Comments by which an author asks to leave findings out, and whether one covers a finding.

======================================  =====================================================================
``roslens: ignore[rule, tag] reason``    this line; without brackets every rule
``roslens: ignore-next-line[…] reason``  the next line
``roslens: ignore-begin[…] reason``      the lines up to ``roslens: ignore-end``, or to the end of the file
``roslens: ignore-file[…] reason``       the whole file, what has no line included
``haros:ignore-line``                    this line, every rule; ``haros:ignore-next-line`` likewise
``NOLINT`` ``NOLINT(rule, …)``           this line; ``NOLINTNEXTLINE`` the next one
``NOLINTBEGIN`` … ``NOLINTEND``          the lines from one to the other
``cppcheck-suppress rule``               the line it is on and the next; ``cppcheck-suppress [rule, …]`` likewise
``noqa`` ``noqa: rule, …``               this line
======================================  =====================================================================

Each has to stand in a comment (``//``, ``/*``, ``*``, ``#``, ``<!--``). A name matches a rule's id, the end of it
after ``.``, ``:`` or ``/`` (``runtime/int`` matches ``cpplint.runtime/int``), one of its tags, or, with ``*``, as a
glob.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Sequence
from fnmatch import fnmatchcase

import msgspec


class Suppression(msgspec.Struct, frozen=True, array_like=True, omit_defaults=True):
    """A comment that asks to leave findings out.

    It covers the lines from ``line`` to ``end_line``. ``rules`` are names as written, none means every rule.
    ``spelled`` is how it was written, up to the rules, and ``comment`` the line on which that stands.
    """

    line: int
    rules: tuple[str, ...] = ()
    reason: str = ""
    spelled: str = ""
    end_line: int = 0
    comment: int = 0


def suppressions(content: bytes) -> tuple[Suppression, ...]:
    """Return the suppressions of a file, in the order of their comments."""
    if not any(word in content for word in _WORDS):
        return ()
    found: list[Suppression] = []
    begun: dict[str, list[Suppression]] = {end: [] for end in _BLOCKS.values()}
    for match, line in _in_comments(content):
        suppression = _read(match, line)
        if suppression is None:
            continue
        if suppression.spelled in _BLOCKS:
            begun[_BLOCKS[suppression.spelled]].append(suppression)
        elif suppression.spelled not in begun:
            found.append(suppression)
        elif begun[suppression.spelled]:
            found.append(msgspec.structs.replace(begun[suppression.spelled].pop(), end_line=line))
    last = content.count(b"\n") + 1
    found.extend(msgspec.structs.replace(one, end_line=last) for open_ in begun.values() for one in open_)
    found = [msgspec.structs.replace(one, line=0, end_line=last) if one.spelled == FILE else one for one in found]
    return tuple(sorted(found, key=lambda suppression: suppression.comment))


def suppressed(rule: str, tags: Collection[str], line: int, known: Sequence[Suppression]) -> bool:
    """Return whether one of the suppressions of a file covers a finding of ``rule`` at ``line``."""
    return bool(covering((rule,), tags, line, known))


def covering(
    rules: Collection[str], tags: Collection[str], line: int, known: Sequence[Suppression]
) -> tuple[Suppression, ...]:
    """Return the suppressions of a file that cover a finding at ``line``.

    Args:
        rules: ids under which the finding is reported: its rule and those of its witnesses.
        tags: of the finding.
        line: of the finding; only suppressions of the whole file cover 0.
        known: the suppressions of the file.
    """
    return tuple(
        suppression
        for suppression in known
        if suppression.line <= line <= suppression.end_line
        and (not suppression.rules or any(names(name, rule, tags) for name in suppression.rules for rule in rules))
    )


FILE = "ignore-file"
"""How a suppression of a whole file is spelled."""

_BLOCKS = {"NOLINTBEGIN": "NOLINTEND", "ignore-begin": "ignore-end"}

_WORDS = (b"NOLINT", b"roslens:", b"haros:", b"noqa", b"cppcheck-suppress")
"""How every marker begins: to look for these five is much cheaper than to try the marker at every byte."""

_MARKER = re.compile(
    rb"""
    (?:
        roslens:[ \t]*(?P<own>ignore-(?:next-line|begin|end|file)(?![-\w])|ignore(?:-line)?(?![-\w]))
      | haros:[ \t]*(?P<haros>ignore-(?:next-)?line)\b
      | \b(?P<lint>NOLINT(?:NEXTLINE|BEGIN|END)?)\b
      | (?P<cppcheck>cppcheck-suppress)\b[ \t]*
      | \b(?P<noqa>noqa)\b(?P<colon>:)?
    )
    (?P<list>\[[^\]\n]*\]|\([^)\n]*\))?
    (?P<rest>[^\n]*?) (?=$|[ \t](?://|\#)[ \t])
    """,
    re.MULTILINE | re.VERBOSE,
)

_OPENING = re.compile(rb"//|/\*|#|<!--|^[ \t]*\*", re.MULTILINE)

_CODE = re.compile(r"[, \t]*([A-Za-z_][\w.:/*-]*)")


def _in_comments(content: bytes) -> Iterator[tuple[re.Match[bytes], int]]:
    """Yield the markers behind the opening of a comment with their 1-based lines."""
    line, start, opened = 1, 0, -1
    counted = 0
    behind = 0
    for at in sorted(place for word in _WORDS for place in _places(word, content)):
        match = _MARKER.match(content, at) if at >= behind else None
        if match is None:
            continue
        behind = match.end()
        if newlines := content.count(b"\n", counted, at):
            line += newlines
            start = content.rfind(b"\n", counted, at) + 1
            opened = -1
        counted = at
        if opened < 0:
            opening = _OPENING.search(content, start, at)
            opened = opening.start() if opening else -1
        if opened >= 0:
            yield match, line


def _places(word: bytes, content: bytes) -> Iterator[int]:
    at = content.find(word)
    while at >= 0:
        yield at
        at = content.find(word, at + 1)


def _read(match: re.Match[bytes], line: int) -> Suppression | None:
    bracketed = match["list"]
    rest = _text(match["rest"])
    given = tuple(name for part in _text(bracketed[1:-1]).split(",") if (name := part.strip())) if bracketed else ()
    spelled = _text(match["own"] or match["haros"] or match["lint"] or match["cppcheck"] or match["noqa"])
    if bracketed and not given:
        return None
    if match["noqa"] and match["colon"]:
        given, rest = _codes(rest)
    elif match["cppcheck"] and not given:
        first, _, rest = rest.strip().partition(" ")
        given = (first,) if first else ()
        if not given:
            return None
    reason = rest.strip().removesuffix("*/").removesuffix("-->").strip(" \t\r:-")
    first_line = line + (spelled in ("ignore-next-line", "NOLINTNEXTLINE"))
    end_line = first_line + (1 if match["cppcheck"] else 0)
    return Suppression(first_line, given, reason, spelled, end_line, line)


def _codes(rest: str) -> tuple[tuple[str, ...], str]:
    """Return the codes after ``noqa:``, which commas or spaces part, and what follows them."""
    codes: list[str] = []
    at = 0
    while match := _CODE.match(rest, at):
        if codes and not any(character.isdigit() for character in match[1]):
            break
        codes.append(match[1])
        at = match.end()
    return tuple(codes), rest[at:]


def names(name: str, rule: str, tags: Iterable[str] = ()) -> bool:
    """Return whether a name in a suppression means a rule with these tags."""
    if "*" in name:
        return fnmatchcase(rule, name) or any(fnmatchcase(rule, f"*{separator}{name}") for separator in ".:/")
    return name == rule or rule.endswith((f".{name}", f":{name}", f"/{name}")) or name in tags


def _text(content: bytes) -> str:
    return content.decode("utf-8", "replace")
