"""The parser of a command line: what it does not know, it names with what comes near to it and where to look."""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Iterator, Sequence
from typing import Any, NoReturn


class CommandParser(argparse.ArgumentParser):
    """A parser that suggests the command, action or choice that a mistyped word may mean."""

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        """Refuse a word that is no command, or no choice of an option.

        Raises:
            ArgumentError: the option has no such choice.
        """
        choices = [str(one) for one in action.choices or ()]
        if isinstance(action, argparse._SubParsersAction) and value not in choices:  # noqa: SLF001 - known no other way
            kind = str(action.metavar or "command").lower()
            self.error(f"there is no {kind} {value!r}.{_meant(value, choices)} {_all_of(self)}")
        try:
            super()._check_value(action, value)
        except argparse.ArgumentError as error:
            error.message += f".{found}" if (found := _meant(str(value), choices)) else ""
            raise


def take_late_words(unknown: Sequence[str], top: argparse.ArgumentParser, options: argparse.Namespace) -> list[str]:
    """Give words after options to the optional positionals that were left empty; return what nothing takes.

    `trend loc --format csv PATH` means the same as `trend loc PATH --format csv`, but argparse fills all positionals
    that may be empty at the first word.

    Args:
        unknown: arguments that no parser knows.
        top: the parser of the whole command line.
        options: what was understood of it; receives the words.
    """
    left = list(unknown)
    if any(word.startswith("-") for word in left):
        return left
    for parser in _chosen(top, options):
        for action in parser._actions:  # noqa: SLF001 - known no other way
            is_empty = not action.option_strings and getattr(options, action.dest, None) == action.default
            if left and is_empty and action.nargs == "?":
                setattr(options, action.dest, _converted(parser, action, left.pop(0)))
            elif left and is_empty and action.nargs == "*":
                setattr(options, action.dest, [_converted(parser, action, word) for word in left])
                left = []
    return left


def _converted(parser: argparse.ArgumentParser, action: argparse.Action, word: str) -> Any:
    value = parser._get_value(action, word)  # noqa: SLF001 - known no other way
    parser._check_value(action, value)  # noqa: SLF001 - known no other way
    return value


def refuse(unknown: Sequence[str], top: argparse.ArgumentParser, options: argparse.Namespace) -> NoReturn:
    """End with what was not understood, what comes near to it of all that could stand there, and where to look.

    Args:
        unknown: arguments that no parser knows.
        top: the parser of the whole command line.
        options: what was understood of it.
    """
    parsers = [top, *_chosen(top, options)]
    words = [word for parser in parsers for action in parser._actions for word in action.option_strings]  # noqa: SLF001 - known no other way
    near = _meant(unknown[0].partition("=")[0], words)
    parsers[-1].error(f"unrecognized arguments: {' '.join(unknown)}.{near} {_all_of(parsers[-1])}")


def _chosen(parser: argparse.ArgumentParser, options: argparse.Namespace) -> Iterator[argparse.ArgumentParser]:
    """Yield the parser of the command that was given, and that of its action."""
    for action in parser._actions:  # noqa: SLF001 - known no other way
        given = getattr(options, action.dest, None)
        if isinstance(action, argparse._SubParsersAction) and given is not None:  # noqa: SLF001 - known no other way
            yield action.choices[given]
            yield from _chosen(action.choices[given], options)


def _meant(word: str, known: Iterable[str]) -> str:
    """Return a question after the known word that comes nearest, with a space before it; empty where none does."""
    from difflib import get_close_matches

    by_lower = {one.lower(): one for one in known}
    near = get_close_matches(word.lower(), by_lower, n=1)
    return f" Did you mean {by_lower[near[0]]}?" if near else ""


def _all_of(parser: argparse.ArgumentParser) -> str:
    return f"`{parser.prog} --help` has all"
