"""Texts of C++, lists and tables that a method changes in place: ``name.append("/raw")``, ``topics.insert(0, "scan")``.

What a change comes to under a condition that is open is not known: whoever reads the value later learns this.
"""

from __future__ import annotations

from fnmatch import fnmatchcase
from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Names, Table, Unknown, Value, as_text
from roslens.source.extract.domain.kinds import is_whole, known_text, table_of, text_of
from roslens.source.extract.domain.table_key import hashable
from roslens.source.extract.domain.word_list import Words
from roslens.source.extract.ir.program import Call, Expression, Member, Name
from roslens.source.extract.symbolic.text import Condition, Text, said, unknown

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_OF_TEXTS = frozenset({"append", "push_back", "insert", "replace", "erase", "assign", "clear", "pop_back", "resize",
                       "swap", "prepend", "remove"})  # fmt: skip
_OF_LISTS = frozenset({"insert", "extend", "remove", "pop", "reverse", "sort", "clear", "pop_back", "push_front",
                       "pop_front", "erase"})  # fmt: skip
_OF_TABLES = frozenset({"update", "pop", "setdefault", "clear", "popitem", "erase"})
_GROWING = frozenset({"insert", "push_front", "reverse", "sort"})
CHANGING = _OF_TEXTS | _OF_LISTS | _OF_TABLES
_MOST_LENGTH = 10_000


def changed_by(
    ctx: Context, written: Expression, of: Value, name: str, arguments: list[Value], keywords: Names
) -> tuple[Value] | None:
    """Change a value by a method of it; return the result of the call, None where the method changes nothing.

    Args:
        ctx: the evaluation.
        written: what the method is called on.
        of: its value.
        name: of the method.
        arguments: of the call.
        keywords: of the call.
    """
    match of:
        case Text():
            changes = ctx.dialect.texts_change and name in _OF_TEXTS
            return _text(ctx, _root(written), of, name, arguments) if changes else None
        case Words():
            return None
        case list() if name in _OF_LISTS:
            return _list(ctx, of, name, [*arguments, *keywords.values()])
        case dict() if name in _OF_TABLES:
            return _table(ctx, of, name, arguments, keywords)
    return None


def is_open(ctx: Context) -> Condition | None:
    """Return the innermost undecidable condition of the function; None without one."""
    frame = ctx.state.frame
    return ctx.state.conditions[-1] if len(ctx.state.conditions) > frame.depth + frame.passed else None


def put_item(ctx: Context, of: Table | list[Value], key: Value, value: Value) -> None:
    """Put an item into a table or list."""
    match of:
        case dict():
            forget_where(ctx, of, key)
            ctx.state.store.put(of, hashable(key), value)
        case list() if is_whole(key) and -len(of) <= key < len(of):
            ctx.state.store.items(of)
            of[key] = value
        case _:
            ctx.state.store.items(of)
            forget_items(of, "an item of a list that was changed")


def forget_where(ctx: Context, of: Table, key: Value) -> None:
    """Let plain values of a table be unknown that a key of which not all is known may be that of."""
    match key:
        case Text() if key.known is None:
            pattern = key.pattern
        case Unknown():
            pattern = "*"
        case _:
            return
    reason = "an item of a table that a key may be of which is not all known"
    for one, value in [item for item in of.items() if fnmatchcase(str(item[0]), pattern)]:
        match value:
            case Text():
                ctx.state.store.put(of, one, unknown(reason))
            case bool() | int() | float():
                ctx.state.store.put(of, one, Unknown(reason))


def _root(written: Expression) -> Expression:
    """Return what is changed where calls are in a row: ``name.append("a").append("b")``."""
    match written:
        case Call(function=Member(of=of, name=name)) if name in _OF_TEXTS:
            return _root(of)
    return written


def _text(ctx: Context, written: Expression, of: Text, name: str, arguments: list[Value]) -> tuple[Value] | None:
    match written:
        case Name() | Member() | Call():
            pass
        case _:
            return None
    listed = of.known is None and name in ("push_back", "insert", "erase", "clear", "pop_back", "resize")
    if listed and not _is_sign(arguments):
        # A parameter may be a list with unknown items.
        found = _doubtful(of, name)
    elif name == "swap" and arguments:
        found = as_text(arguments[0])
    else:
        known = _changed(of, name, arguments)
        found = _doubtful(of, name) if known is None else known
    ctx.assign(written, found)
    return (found,)


def _is_sign(arguments: list[Value]) -> bool:
    return len(arguments) == 1 and len(known_text(arguments[0]) or "") == 1


def _doubtful(of: Text, name: str) -> Text:
    parameter = next((hole.parameter for hole in of.holes), "")
    return unknown(said(of, f", which {name}() changed", most=200), parameter=parameter)


def _changed(of: Text, name: str, arguments: list[Value]) -> Text | None:
    """Return a text after a change; None where that is unknown. ``name`` is a method of std::string, or of QString."""
    texts = [text_of(one) for one in arguments]
    numbers = [one if type(one) is int and one >= 0 else None for one in arguments]
    if name == "clear":
        return Text.of("")
    if name in ("append", "push_back", "prepend") and len(texts) == 1:
        added = as_text(arguments[0])
        return Text.of(added, of) if name == "prepend" else Text.of(of, added)
    if name == "assign" and len(texts) == 1 and texts[0] is not None:
        return texts[0]
    if name == "pop_back" and of.tail:
        return Text.of(*of.parts[:-1], of.tail[:-1])
    known = of.known
    if known is None or any(one is None and other is None for one, other in zip(texts, numbers, strict=True)):
        return None
    changed = _changed_at(known, name, texts, numbers)
    return _replaced(known, name, texts) if changed is None else changed


def _changed_at(known: str, name: str, texts: list[Text | None], numbers: list[int | None]) -> Text | None:
    """Return a text that is changed at a place by its number; None where it is not, or that is unknown."""
    match name, numbers, texts:
        case "insert", [int(place), _], [_, Text() as added]:
            return Text.of(known[:place], added, known[place:])
        case "erase", [] | [int()] | [int(), int()], _:
            begin, count = (*numbers, None, None)[:2]
            begin = begin or 0
            return Text.of(known[:begin], "" if count is None else known[begin + count :])
        case "resize", [int(length)], _ if length <= len(known):
            return Text.of(known[:length])
        case "replace", [int(begin), int(count), _], [_, _, Text() as put]:
            return Text.of(known[:begin], put, known[begin + count :])
    return None


def _replaced(known: str, name: str, texts: list[Text | None]) -> Text | None:
    """Return a text in which one is replaced by another wherever it stands, or removed; None where it is not."""
    plain = [one.known for one in texts if one is not None and one.known]
    if name in ("replace", "remove") and len(plain) == len(texts) == (2 if name == "replace" else 1):
        return Text.of(known.replace(plain[0], plain[1] if name == "replace" else "")[:_MOST_LENGTH])
    return None


def _list(ctx: Context, of: list[Value], name: str, arguments: list[Value]) -> tuple[Value]:
    match name, arguments:
        case "extend", [Words(), *_]:
            pass
        case "extend", [list(added), *_]:
            ctx.state.store.items(of)
            of += added
            return (None,)
    ctx.state.store.items(of, less=name not in _GROWING)
    changed = None if is_open(ctx) else _list_for_sure(of, name, arguments)
    return changed or (forget_items(of, f"an item of a list that {name}() changed"),)


def _list_for_sure(of: list[Value], name: str, arguments: list[Value]) -> tuple[Value] | None:
    """Change a list; return the result of the call, None where it is unknown what changes."""
    match name, arguments:
        case "insert", [int(place), value] if is_whole(place):
            of.insert(place, value)
        case "push_front", [value, *_]:
            of.insert(0, value)
        case (("pop" | "pop_back" | "pop_front"), _) if of and (not arguments or _is_place(arguments[0], of)):
            place = arguments[0] if arguments and is_whole(arguments[0]) else -1
            return (of.pop(0 if name == "pop_front" else place),)
        case "clear", _:
            of.clear()
        case "reverse", []:
            of.reverse()
        case "remove", [value, *_] if _all_known(of) and value in of:
            of.remove(value)
        case "sort", [] if _all_known(of):
            of.sort(key=lambda one: known_text(one) or "")
        case _:
            return None
    return (None,)


def _is_place(value: Value, of: list[Value]) -> bool:
    return type(value) is int and -len(of) <= value < len(of)


def _all_known(of: list[Value]) -> bool:
    return all(known_text(one) is not None for one in of)


def forget_items(of: list[Value] | Table, reason: str) -> Unknown:
    """Let nothing be known of the items: who else holds the list or table sees it too."""
    match of:
        case list():
            of[:] = [Unknown(reason)] * len(of)
        case dict():
            of.update(dict.fromkeys(of, Unknown(reason)))
    return Unknown(reason)


def _table(
    ctx: Context, of: Table, name: str, arguments: list[Value], keywords: Names,
) -> tuple[Value]:  # fmt: skip
    first = arguments[0] if arguments else None
    match name, first:
        case "update", None | dict():
            for key, value in (*table_of(first).items(), *((Text.of(one), keywords[one]) for one in keywords)):
                put_item(ctx, of, key, value)
            return (None,)
    if name == "setdefault" and arguments:
        if hashable(first) not in of:
            ctx.state.store.put(of, hashable(first), arguments[1] if len(arguments) > 1 else None)
        return (of[hashable(first)],)
    ctx.state.store.items(of, less=True)
    changed = None if is_open(ctx) else _table_for_sure(of, name, arguments)
    return changed or (forget_items(of, f"an item of a dictionary that {name}() changed"),)


def _table_for_sure(of: Table, name: str, arguments: list[Value]) -> tuple[Value] | None:
    """Take items out of a table; return the result of the call, None where it is unknown which."""
    match name, arguments:
        case "clear", _:
            of.clear()
            return (None,)
        case (("pop" | "erase"), [key, *rest]) if _is_key(key):
            return (of.pop(hashable(key), rest[0] if rest else Unknown("an item")),)
    return None


def _is_key(value: Value) -> bool:
    match value:
        case int() | str():
            return True
    return known_text(value) is not None
