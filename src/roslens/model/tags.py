"""Which findings are meant, said by their tags.

Two ways to say it, distinguished by a comma or a leading sign:

- an expression: ``complexity and not (his or kth)``. ``not`` binds tighter than ``and``, ``and`` tighter than
  ``or``; ``!``, ``&`` and ``|`` are other spellings.
- a list: ``+ros,-metrics,style``. A finding matches when it has at least one of the tags without ``-`` (any tag will do
  when there is none such) and none of the tags with ``-``.

Tags are compared without regard to case. An empty text matches everything.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import NoReturn

import msgspec

from roslens.model.errors import UsageError

MAX_DEPTH = 50
"""Parentheses and ``not`` inside each other; more is no expression that a person writes."""

_TOKEN = re.compile(r"[()!&|]|[^\s()!&|,]+|,")
_SPELLINGS = {"!": "not", "&": "and", "|": "or"}
_STRENGTH = {"or": 0, "and": 1, "not": 2}
_EXAMPLE = "an expression such as 'complexity and not his' or a list such as '+ros,-metrics'"


class TagFilter(msgspec.Struct, frozen=True):
    """A condition on the tags of a finding.

    ``steps`` is the condition in postfix order: a tag (in lower case, with a leading ``=``), ``not``, ``and`` or
    ``or``. No steps match everything.
    """

    steps: tuple[str, ...] = ()

    def __bool__(self) -> bool:
        """Whether anything is filtered at all."""
        return bool(self.steps)

    def __str__(self) -> str:
        """Return the condition as an expression; empty where nothing is filtered."""
        stack: list[tuple[str, int]] = []
        for step in self.steps:
            if step == "not":
                text, strength = stack.pop()
                stack.append((f"not {text}" if strength >= _STRENGTH["not"] else f"not ({text})", _STRENGTH["not"]))
            elif step in _STRENGTH:
                sides = [stack.pop(), stack.pop()]
                own = _STRENGTH[step]
                written = [text if strength >= own else f"({text})" for text, strength in reversed(sides)]
                stack.append((f" {step} ".join(written), own))
            else:
                stack.append((step[1:], _STRENGTH["not"]))
        return stack[0][0] if stack else ""

    @property
    def names(self) -> tuple[str, ...]:
        """The tags that the condition names, each once, in order of appearance."""
        return tuple(dict.fromkeys(step[1:] for step in self.steps if step.startswith("=")))

    def matches(self, tags: Iterable[str]) -> bool:
        """Return whether a finding with these tags is meant."""
        if not self.steps:
            return True
        held = {tag.casefold() for tag in tags}
        stack: list[bool] = []
        for step in self.steps:
            if step == "not":
                stack.append(not stack.pop())
            elif step == "and":
                right, left = stack.pop(), stack.pop()
                stack.append(left and right)
            elif step == "or":
                right, left = stack.pop(), stack.pop()
                stack.append(left or right)
            else:
                stack.append(step[1:] in held)
        return stack.pop()

    def both(self, other: TagFilter) -> TagFilter:
        """Return the filter that matches what this one and ``other`` match."""
        if not self or not other:
            return self or other
        return TagFilter((*self.steps, *other.steps, "and"))


def tag_filter(include: Iterable[str] = (), exclude: Iterable[str] = ()) -> TagFilter:
    """Return the filter of a list: at least one of ``include`` (if there is any), none of ``exclude``."""
    wanted = _joined(include, "or")
    unwanted = _joined(exclude, "or")
    return TagFilter(wanted).both(TagFilter((*unwanted, "not") if unwanted else ()))


def parse_tags(text: str) -> TagFilter:
    """Read a tag expression or a list of tags.

    Raises:
        UsageError: the text is neither, with the column at which it stops being one.
    """
    if not text.strip():
        return TagFilter()
    if "," in text or text.lstrip()[0] in "+-":
        return _parse_list(text)
    return _Expression(text).parse()


def _joined(tags: Iterable[str], operator: str) -> tuple[str, ...]:
    steps: list[str] = []
    for tag in dict.fromkeys(tag.casefold() for tag in tags):
        steps.append("=" + tag)
        if len(steps) > 1:
            steps.append(operator)
    return tuple(steps)


def _parse_list(text: str) -> TagFilter:
    include: list[str] = []
    exclude: list[str] = []
    column = 1
    for item in text.split(","):
        start = column + len(item) - len(item.lstrip())
        column += len(item) + 1
        sign, tag = _split_sign(item.strip())
        if not tag:
            _fail(text, start, "no tag between the commas" if not sign else f"{sign!r} without a tag")
        if not _TOKEN.fullmatch(tag) or tag in _SPELLINGS or tag in "()":
            _fail(text, start, f"{tag!r} in a list of tags")
        (exclude if sign == "-" else include).append(tag)
    return tag_filter(include, exclude)


def _split_sign(item: str) -> tuple[str, str]:
    return (item[0], item[1:].strip()) if item[:1] in {"+", "-"} else ("", item)


def _fail(text: str, column: int, what: str) -> NoReturn:
    raise UsageError(
        f"{what} in the tag expression {text!r}",
        where=f"column {column}",
        expected=_EXAMPLE,
        advice="`roslens plugins` lists the tags of every rule",
    )


class _Expression:
    """Recursive descent over one text; each method appends what it read to ``steps``."""

    def __init__(self, text: str) -> None:
        self._text = text
        self._tokens = [(match.start() + 1, match.group()) for match in _TOKEN.finditer(text)]
        self._next = 0
        self._depth = 0
        self._steps: list[str] = []

    def parse(self) -> TagFilter:
        self._either()
        if self._next < len(self._tokens):
            column, found = self._tokens[self._next]
            _fail(self._text, column, f"unexpected {found!r}")
        return TagFilter(tuple(self._steps))

    def _word(self) -> str:
        """Return the next token as the grammar sees it: an operator, a bracket, a tag or ''."""
        if self._next == len(self._tokens):
            return ""
        token = self._tokens[self._next][1]
        token = _SPELLINGS.get(token, token)
        return token.lower() if token.lower() in _STRENGTH else token

    def _either(self) -> None:
        self._both()
        while self._word() == "or":
            self._next += 1
            self._both()
            self._steps.append("or")

    def _both(self) -> None:
        self._one()
        while self._word() == "and":
            self._next += 1
            self._one()
            self._steps.append("and")

    def _one(self) -> None:
        word = self._word()
        column = self._tokens[self._next][0] if word else len(self._text) + 1
        self._depth += 1
        if self._depth > MAX_DEPTH:
            _fail(self._text, column, f"more than {MAX_DEPTH} levels")
        self._next += 1
        if word == "not":
            self._one()
            self._steps.append("not")
        elif word == "(":
            self._either()
            if self._word() != ")":
                _fail(self._text, column, "'(' without its ')'")
            self._next += 1
        elif not word or word == ")" or word in _STRENGTH:
            _fail(self._text, column, f"unexpected {word!r} where a tag was expected" if word else "a tag is missing")
        else:
            self._steps.append("=" + word.casefold())
        self._depth -= 1
