"""Values of CMake: texts, of which a part may be unknown, and lists, which are texts with semicolons.

An unknown part is a *hole*: its reason between two private characters, so that a value stays one text through all
that is done with it.
"""

from __future__ import annotations

import re
import warnings
from functools import lru_cache

OPEN, CLOSE = "\ue000", "\ue001"
_MADE = "\ue002"
"""Behind what opens a hole: it stands for files that the build makes."""
_HOLE = re.compile(f"{OPEN}({_MADE}?)([^{OPEN}{CLOSE}]*){CLOSE}")

_TRUE = frozenset({"1", "ON", "YES", "TRUE", "Y"})
_FALSE = frozenset({"", "0", "OFF", "NO", "FALSE", "N", "IGNORE"})
_NUMBER = re.compile(
    r"\s*([+-]?)(?:(0x(?:[0-9a-f]+\.?[0-9a-f]*|\.[0-9a-f]+)(?:p[+-]?\d+)?)"
    r"|((?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?|inf(?:inity)?|nan))",
    re.ASCII | re.IGNORECASE,
)
"""What ``strtod`` of C takes for a number."""
_MOST_WORK = 10_000_000
_NESTED = re.compile(r"[*+?]\)[*+?]|\)[*+][*+]")
_LIST_SIGN = re.compile(r"\\;|[;\[\]]")
_DEPTH = {"[": 1, "]": -1}
_PIECE = re.compile(
    r"\[(?P<negated>\^?)(?P<bracket>\]?)(?P<signs>[^\]]*)(?P<end>\]?)|\\(?P<escaped>.)|\(\?|(?P<sign>.)", re.DOTALL
)
"""A set within brackets, an escaped sign, the beginning of a group that CMake does not know, or another sign."""
_SIGNS = {"{": r"\{", "}": r"\}", "$": r"\Z"}
_PLAIN_IN_SET = re.compile(r"[\\\[&~|]")


def hole(reason: str) -> str:
    """Return a text of which nothing is known but why."""
    return OPEN + reason.replace(OPEN, "").replace(CLOSE, "").replace(";", ",") + CLOSE


def made_by(command: str) -> str:
    """Return a text that stands for files which a command of the build makes."""
    return f"{OPEN}{_MADE}files that are made by {command}(){CLOSE}"


def is_made(value: str) -> bool:
    """Return whether what is unknown first in a value are files that the build makes."""
    found = _HOLE.search(value)
    return found is not None and bool(found[1])


def is_unknown(value: str) -> bool:
    """Return whether a part of a value is unknown."""
    return OPEN in value


def reason_of(value: str) -> str:
    """Return why a value is unknown; empty where it is known."""
    found = _HOLE.search(value)
    return found[2] if found else ""


def shown(value: str) -> str:
    """Return a value for people: holes as ``{reason}``."""
    return _HOLE.sub(r"{\2}", value) if OPEN in value else value


def items_of(value: str, *, empty: bool = False) -> list[str]:
    """Return the items of a list: parted at semicolons that are not escaped nor within brackets.

    Args:
        value: the list.
        empty: whether empty items count, as they do in commands on lists but not in arguments.
    """
    if ";" not in value:
        return [value] if value else []
    if "[" not in value and "]" not in value and "\\" not in value:
        return [item for item in value.split(";") if item or empty]
    found: list[str] = []
    start = depth = 0
    for match in _LIST_SIGN.finditer(value):
        # A bracket that nothing opens keeps together what follows, too.
        depth += _DEPTH.get(match[0], 0)
        if match[0] == ";" and depth == 0:
            found.append(value[start : match.start()])
            start = match.end()
    found.append(value[start:])
    return [item.replace("\\;", ";") for item in found if item or empty]


def is_off(value: str) -> bool:
    """Return whether the value of a variable is taken for false."""
    return value.upper() in _FALSE or value == "NOTFOUND" or value.endswith("-NOTFOUND")


def truth_of(value: str) -> bool | None:
    """Return what a constant is taken for; None of other texts."""
    if value.upper() in _TRUE:
        return True
    if is_off(value):
        return False
    match = _NUMBER.fullmatch(value)
    return _number(match) != 0 if match else None


def number_of(value: str) -> float | None:
    """Return the number that a text begins with; None where it begins with none."""
    match = _NUMBER.match(value[:60])
    return _number(match) if match else None


def _number(match: re.Match[str]) -> float:
    sign, hexadecimal, decimal = match.groups()
    try:
        return float.fromhex(sign + hexadecimal) if hexadecimal else float(sign + decimal)
    except OverflowError:
        return float(f"{sign}inf")


def versions_compared(left: str, right: str) -> int:
    """Return -1, 0 or 1: how versions compare. What is no number is 0, and of a negative one C makes a huge one."""
    at, other = 0, 0
    while left[at : at + 1] in _DIGITS or right[other : other + 1] in _DIGITS:
        one, at = _component(left, at)
        two, other = _component(right, other)
        if one != two:
            return -1 if one < two else 1
    return 0


_COMPONENT = re.compile(r"\s*([+-]?)(\d+)", re.ASCII)
_DIGITS = frozenset("0123456789")


def _component(version: str, at: int) -> tuple[int, int]:
    match = _COMPONENT.match(version, at)
    if match:
        at = match.end()
    number = min(int(match[2][:20]), 2**64 - 1) if match else 0
    value = (2**64 - number) % 2**64 if match and match[1] == "-" else number
    return value, at + version.startswith(".", at)


@lru_cache(maxsize=512)
def expression_of(pattern: str) -> re.Pattern[str] | None:
    """Return a regular expression of CMake; None where it is wrong or could take for ever."""
    if len(pattern) > 500 or OPEN in pattern or _NESTED.search(pattern):
        return None
    pieces = list(_PIECE.finditer(pattern))
    if any(piece[0] == "(?" for piece in pieces):
        return None
    try:
        with warnings.catch_warnings():
            # Python warns of what CMake has another meaning for: two hyphens within brackets.
            warnings.simplefilter("ignore", FutureWarning)
            return re.compile("".join(map(_translated, pieces)), re.DOTALL)
    except (re.error, RecursionError, OverflowError):
        return None


def _translated(piece: re.Match[str]) -> str:
    """Return what means in Python what a piece of a regular expression means in CMake."""
    if sign := piece["sign"]:
        return _SIGNS.get(sign, sign)
    if escaped := piece["escaped"]:
        return re.escape(escaped)
    # A backslash is a character like any other within brackets.
    signs = _PLAIN_IN_SET.sub(r"\\\g<0>", piece["signs"])
    return f"[{piece['negated']}{re.escape(piece['bracket'])}{signs}{piece['end']}"


def searchable(pattern: re.Pattern[str], value: str) -> bool:
    """Return whether a search ends soon: its steps grow with the length to the power of its repetitions."""
    repeated = sum(pattern.pattern.count(sign) for sign in "*+?")
    steps: int = (len(value) + 1) ** min(repeated + 1, 8)
    return steps <= _MOST_WORK
