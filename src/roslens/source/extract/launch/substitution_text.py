"""Substitutions as XML and YAML launch files of ROS 2 write them: ``$(var x)``, ``$(find-pkg-share p)/launch``.

The grammar is that of ``launch.frontend.parse_substitution``: arguments are parted by spaces, may stand in quotes, and
may hold substitutions themselves.
"""

from __future__ import annotations

import shlex

from roslens.source.extract.launch_python.deferred import Deferred, Value
from roslens.source.extract.launch_python.launch_action import text, unknown_value

_MOST_DEPTH = 20
MOST_OF_EVAL = 2
"""Arguments of ``$(eval …)``: the expression, and in newer distributions names of modules."""
_QUOTES = "'\""
_KINDS = {
    "var": "configuration",
    "env": "environment",
    "find-pkg-share": "share",
    "find-pkg-prefix": "prefix",
    "find-pkg": "prefix",
    "not": "not",
    "and": "and",
    "or": "or",
    "any": "or",
    "all": "and",
    "equals": "equals",
    "not-equals": "unequal",
    "dirname": "folder",
    "filename": "file",
    "anon": "anonymous",
    "command": "command",
    "path-join": "path",
    "string-join": "join",
    "file-content": "content",
    "for-var": "turn",
    "index": "turn",
    "if": "if",
}

_AT_START = {
    "exec-in-pkg": "path of a program",
    "find-exec": "path of a program",
    "launch_log_dir": "folder of the logs of this start",
    "log_dir": "folder of the logs of this start",
    "param": "value of a global parameter",
    "ament-index-resource": "path of a resource of the index of packages",
}
"""Substitutions that are known when a launch file is started."""


def parse(written: str, depth: int = 0) -> Value:
    """Return a text with its substitutions; what is no substitution is unknown with the reason."""
    return text(*_pieces(written, depth))


def words(written: str) -> tuple[Value, ...]:
    """Return the words of a command line: texts are parted by white space, what a substitution comes to is not.

    As ``launch.actions.ExecuteProcess`` parts them, which takes quotes in texts as a shell does.
    """
    found: list[list[Value]] = [[]]
    for piece in _pieces(written, 0) if written.strip() else ():
        match piece:
            case str():
                try:
                    _go_on(found, piece)
                except ValueError as error:
                    return (unknown_value(f"the words of {written!r}: {error}"),)
            case _:
                found[-1].append(piece)
    return tuple(text(*one) for one in (found if found[-1] else found[:-1]))


def _go_on(found: list[list[Value]], piece: str) -> None:
    """Add the words of a text: the first goes on with the last one that was found, unless a space parts them.

    Raises:
        ValueError: a quotation in it does not end.
    """
    first, *more = shlex.split(piece) or [""]
    if not (first or more or piece.strip()):
        found.append([])
        return
    if piece[0].isspace() and found[-1]:
        found.append([])
    found[-1].append(first)
    found.extend([one] for one in more)
    if piece[-1].isspace():
        found.append([])


def _pieces(written: str, depth: int) -> list[Value]:
    """Return the texts and substitutions that a text is made of."""
    if depth > _MOST_DEPTH:
        return [unknown_value("too deeply nested substitutions")]
    parts: list[Value] = []
    at = 0
    while (begin := _begin(written, at)) >= 0:
        end = _closing(written, begin + 2)
        if end < 0:
            return [unknown_value(f"the bracket of {written[begin : begin + 40]!r} is never closed")]
        if begin > at:
            parts.append(_plain(written[at:begin]))
        parts.append(_one(written[begin + 2 : end], depth + 1))
        at = end + 1
    if at < len(written) or not parts:
        parts.append(_plain(written[at:]))
    return parts


def _begin(written: str, at: int) -> int:
    begin = written.find("$(", at)
    while begin > 0 and written[begin - 1] == "\\":
        begin = written.find("$(", begin + 2)
    return begin


def _plain(written: str) -> str:
    return written.replace("\\$(", "$(")


def _closing(written: str, at: int) -> int:
    depth, quote = 1, ""
    for place in range(at, len(written)):
        sign = written[place]
        if quote:
            quote = "" if sign == quote else quote
        elif sign in _QUOTES and depth == 1:
            quote = sign
        else:
            depth += (sign == "(") - (sign == ")")
            if not depth:
                return place
    # A lone apostrophe is no quote.
    depth = 1
    for place in range(at, len(written)):
        depth += (written[place] == "(") - (written[place] == ")")
        if not depth:
            return place
    return -1


def _one(inside: str, depth: int) -> Value:
    command, _, rest = inside.strip().partition(" ")
    if command == "eval" and (count := arguments_of(rest)) > 1:
        if count == MOST_OF_EVAL and rest.strip()[0] in _QUOTES:
            return unknown_value(f"an expression with modules: {inside}")
        reason = f"it has {count} arguments, parted by blanks; expected the expression in quotes"
        return Deferred("refused", (f"$({inside})", reason))
    if command in ("eval", "command"):
        # Everything behind the word is one text, its outer quotes left out.
        return Deferred("python" if command == "eval" else "command", (parse(_unquoted(rest.strip()), depth),))
    arguments = [parse(one, depth) for one in _words(rest)]
    kind = _KINDS.get(command)
    if command in _AT_START:
        return unknown_value(f"{_AT_START[command]}: {inside}")
    if kind is None:
        return unknown_value(f"unsupported substitution $({inside})")
    if not arguments and kind not in ("folder", "file"):
        return unknown_value(f"substitution $({inside}) without an argument")
    return Deferred(kind, tuple(arguments))


def arguments_of(rest: str) -> int:
    """Return how many arguments a substitution has: blanks part them outside of quotes and brackets.

    As the grammar of launch has it, in which a backslash takes the meaning of the sign behind it.
    """
    count, depth, quote, is_open = 0, 0, "", False
    signs = iter(rest.strip())
    for sign in signs:
        if sign == "\\":
            next(signs, "")
        elif depth:
            depth += (sign == "(") - (sign == ")")
        elif sign == " " and not quote:
            is_open = False
            continue
        elif sign == "(" and not quote:
            depth = 1
        elif sign in _QUOTES and quote in ("", sign):
            quote = "" if quote else sign
        if not is_open:
            count, is_open = count + 1, True
    return count


def _unquoted(written: str) -> str:
    if len(written) < 2 or written[0] != written[-1] or written[0] not in _QUOTES:
        return written
    quote, inside = written[0], written[1:-1]
    # One inside that is escaped does not end it.
    plain = inside.replace(f"\\{quote}", "")
    return inside.replace(f"\\{quote}", quote) if quote not in plain and not plain.endswith("\\") else written


def _words(written: str) -> list[str]:
    words: list[str] = []
    word, quote, depth, begun = "", "", 0, False
    for sign in written:
        if depth or not _is_mark(sign, quote):
            depth += (sign == "(") - (sign == ")")
            word += sign
        elif quote:
            quote = ""
        elif sign in _QUOTES:
            quote, begun = sign, True
        else:
            words += [word] if word or begun else []
            word, begun = "", False
    return [*words, word] if word or begun else words


def _is_mark(sign: str, quote: str) -> bool:
    """Whether a sign outside of brackets is no part of a word: it ends the quotation, begins one, or parts words."""
    return sign == quote if quote else sign in _QUOTES or sign.isspace()
