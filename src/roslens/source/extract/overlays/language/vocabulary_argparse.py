"""The vocabulary of argparse: what the words of a command line come to in a program of Python."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Foreign, Names, Obj, Unknown, Value
from roslens.source.extract.domain.kinds import (
    all_of_kind,
    is_whole,
    items_of,
    known_text,
    name_of,
    object_of,
    table_of,
)
from roslens.source.extract.interpreter.vocabulary import CallSite, method, outer
from roslens.source.extract.symbolic.text import Conditions, Hole, Text, Written, unknown

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_PARSER, _SPACE = "argparse.ArgumentParser", "argparse.Namespace"
_OPTIONS, _DEFAULTS, _LOST, _UNDER = "-options", "-defaults", "-lost", "-conditions"
_FLAGS = {"store_true": True, "store_false": False}
_SEVERAL = frozenset({"*", "+"})


class Option(Foreign, frozen=True):
    """An argument that a parser knows.

    Attributes:
        names: ``--topic``, ``-t``; of a positional one none.
        dest: where its value is found.
        default: where it is not given.
        kind: ``text``, ``int``, ``float``; empty where it is made by a function that is not known.
        action: ``store``, ``store_true``, ``store_false``; anything else is not followed.
        nargs: how many words it takes: a number, ``*`` and ``+`` for all that follow, ``?`` for one at most.
    """

    names: tuple[str, ...]
    dest: str
    default: Value = None
    kind: str = "text"
    action: str = "store"
    nargs: int | str = ""

    @property
    def shown(self) -> str:
        """Its name for people."""
        return self.names[0] if self.names else self.dest


class _Under(Foreign, frozen=True):
    """The conditions under which a parser is made."""

    conditions: Conditions


class LostError(Exception):
    """What the words come to is not known."""


@outer(_PARSER)
def parser(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A parser of command lines; what parents of it know is not followed."""
    found = object_of(thing) or Obj(_PARSER)
    found.fields.update({_OPTIONS: [], _DEFAULTS: {}, _LOST: "parents" in called.keywords})
    found.fields[_UNDER] = _Under(tuple(ctx.state.conditions))
    return found


@method(_PARSER, "add_argument_group", "add_mutually_exclusive_group")
def group(_ctx: Context, thing: Value, _called: CallSite) -> Value:
    """A group of arguments is part of its parser."""
    return thing


@method(_PARSER, "add_subparsers")
def commands(_ctx: Context, thing: Obj, _called: CallSite) -> Value:
    """Commands have parsers of their own, which are not followed."""
    thing.fields[_LOST] = True
    return Unknown("parsers of commands")


@method(_PARSER, "set_defaults", anywhere=True)
def defaults(ctx: Context, thing: Value, called: CallSite) -> Value:
    """Values where nothing is given; a function among them is what a command of the command line does."""
    match thing:
        case Obj():
            held = thing.fields[_DEFAULTS] = {**table_of(thing.fields.get(_DEFAULTS))}
            held.update(called.keywords.items())
    for one in called.keywords.values():
        ctx.callbacks.give(one, Written("the command line requests it"))
    return None


@method(_PARSER, "add_argument")
def option(ctx: Context, thing: Obj, called: CallSite) -> Value:
    """An argument is made known to the parser."""
    names = [known_text(one) for one in called.arguments]
    known = [one for one in names if one]
    if len(known) < len(names) or not known or _Under(tuple(ctx.state.conditions)) != thing.fields.get(_UNDER):
        thing.fields[_LOST] = True
        return None
    given = called.keywords
    optional = known[0].startswith("-")
    long = [one for one in known if one.startswith("--")]
    dest = _text(given.get("dest")) or (long or known)[0].lstrip("-").replace("-", "_" if optional else "-")
    action = _text(given["action"]) if "action" in given else "store"
    default = given.get("default", not _FLAGS[action] if action in _FLAGS else None)
    several = given.get("nargs", "")
    nargs = several if is_whole(several) else _text(several)
    items_of(thing.fields.setdefault(_OPTIONS, [])).append(
        Option(tuple(known) if optional else (), dest, default, _kind(given.get("type")), action, nargs)
    )
    return None


def _text(value: Value) -> str:
    return known_text(value) or ""


def _kind(value: Value) -> str:
    if value is None:
        return "text"
    name = name_of(value).removeprefix("builtins.")
    return {"str": "text", "int": "int", "float": "float"}.get(name, "")


@method(_PARSER, "parse_args", "parse_known_args")
def parsed(ctx: Context, thing: Obj, called: CallSite) -> Value:
    """The words are taken apart."""
    words = called.argument(0, "args")
    if words is None and ctx.given.words is not None:
        words = ctx.given.words.part(1, None)
    rest = called.name == "parse_known_args"
    options = all_of_kind(items_of(thing.fields.get(_OPTIONS)), Option)
    lost = bool(thing.fields.get(_LOST))
    held = {} if lost else table_of(thing.fields.get(_DEFAULTS))
    given: Names = {name: held[name] for name in all_of_kind(held, str)}
    match words:
        case list() if not lost:
            known = _known(options, words, rest=rest)
        case _:
            known = None
    values = {**given, **known} if known is not None else _unknown_all(options, given)
    space = Obj(_SPACE, None, values)
    return [space, Unknown("arguments unknown to the parser")] if rest else space


def _known(options: Sequence[Option], words: Sequence[Value], *, rest: bool) -> Names | None:
    try:
        return values_of(options, words, rest=rest)
    except LostError:
        return None


def _unknown_all(options: Sequence[Option], given: Names) -> Names:
    values = {one.dest: _unknown(one) for one in options}
    return values | {name: _unknown(Option((), name, value)) for name, value in given.items()}


def _unknown(one: Option) -> Value:
    """Return the value of an argument that may be given; its default is usual."""
    reason = f"argument {one.shown}"
    match one:
        case Option(kind="text", action="store", nargs=str(), default=Text(usual=usual)):
            return Text((Hole(reason, default=usual),))
        case Option(kind="text", action="store", nargs=str(), default=None | Unknown()):
            return unknown(reason)
    return Unknown(reason)


def values_of(options: Sequence[Option], words: Sequence[Value], *, rest: bool) -> Names:
    """Return the values of arguments by where they are found, as argparse does.

    Raises:
        LostError: the words hold something that is not followed, or that no parser would take.
    """
    values: Names = {one.dest: one.default for one in options}
    plain: list[Value] = []
    waiting = list(words)
    while waiting:
        word = waiting.pop(0)
        known = known_text(word)
        if known is None or known == "--":
            raise LostError
        if not _is_option(known):
            plain.append(word)
            continue
        if known == "--ros-args" and rest:
            # All that is behind it is for ROS; whatever the parser takes of it is left over.
            break
        one, value = _meant(options, known)
        values[one.dest] = _taken(one, value, waiting)
    _place(options, plain, values, rest=rest)
    return values


def _is_option(word: str) -> bool:
    return word.startswith("-") and len(word) > 1 and not word[1:].replace(".", "", 1).isdigit()


def _meant(options: Sequence[Option], word: str) -> tuple[Option, Text | None]:
    """Return the argument that a word names, with the value that is in the same word."""
    name, sign, value = word.partition("=")
    given = Text.of(value) if sign else None
    for one in options:
        if name in one.names:
            return one, given
    if word.startswith("--"):
        begun = [one for one in options if any(other.startswith(name) for other in one.names)]
        if len(begun) == 1:
            return begun[0], given
    else:
        for one in options:
            if word[:2] in one.names and one.action == "store":
                return one, Text.of(word[2:])
    raise LostError


def _taken(one: Option, value: Text | None, waiting: list[Value]) -> Value:
    """Return the value of an argument; words that belong to it are taken from those that follow."""
    if one.action in _FLAGS:
        return _FLAGS[one.action]
    match one:
        case Option(action="store", nargs="*" | "+"):
            several: list[Value] = []
            while waiting and not _is_option(known_text(waiting[0]) or "-x"):
                several.append(_as_kind(one, waiting.pop(0)))
            return several
        case Option(action="store", nargs=str(nargs)) if nargs != "?":
            if value is not None:
                return _as_kind(one, value)
            if waiting and not _is_option(known_text(waiting[0]) or ""):
                return _as_kind(one, waiting.pop(0))
    raise LostError


def _as_kind(one: Option, value: Value) -> Value:
    if one.kind == "text":
        return value
    try:
        known = _text(value)
        return (
            int(known)
            if one.kind == "int"
            else float(known)
            if one.kind == "float"
            else Unknown(f"argument {one.shown}")
        )
    except ValueError:
        return Unknown(f"argument {one.shown}")


def _place(options: Sequence[Option], plain: list[Value], values: Names, *, rest: bool) -> None:
    """Give positional arguments their words."""
    places = [one for one in options if not one.names]
    for number, one in enumerate(places):
        last = number == len(places) - 1
        if one.nargs in _SEVERAL and last:
            values[one.dest] = [_as_kind(one, word) for word in plain]
            plain = []
        elif one.nargs == "?" and last:
            values[one.dest] = _as_kind(one, plain.pop(0)) if plain else one.default
        elif one.nargs == "" and plain:
            values[one.dest] = _as_kind(one, plain.pop(0))
        else:
            raise LostError
    if plain and not rest:
        raise LostError
