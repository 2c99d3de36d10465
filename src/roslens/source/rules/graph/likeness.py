"""How alike two names are: the number of typing mistakes between them."""

from __future__ import annotations

import re


def distance(one: str, other: str, most: int = 3) -> int:
    """Return how many signs to put in, leave out, change or swap with their neighbour; ``most`` + 1 where more.

    The restricted distance of Damerau and Levenshtein.
    """
    if abs(len(one) - len(other)) > most:
        return most + 1
    before: list[int] = []
    last = list(range(len(other) + 1))
    for row, sign in enumerate(one, 1):
        line = [row]
        for column, against in enumerate(other, 1):
            cost = min(last[column] + 1, line[-1] + 1, last[column - 1] + (sign != against))
            swapped = row > 1 and column > 1 and sign == other[column - 2] and one[row - 2] == against
            line.append(min(cost, before[column - 2] + 1) if swapped else cost)
        if min(line) > most:
            return most + 1
        before, last = last, line
    return min(last[-1], most + 1)


def alike(one: str, other: str) -> bool:
    """Return whether one name may be the other one with a typing mistake: one in four signs, at most two."""
    if one == other:
        return False
    allowed = min(2, max(len(one), len(other)) // 4)
    return distance(one, other, 2) <= allowed


def nearest_name(name: str, valid: list[str]) -> str:
    """Return the valid name that is most alike; empty where none is."""
    near = [(distance(name, one), one) for one in dict.fromkeys(valid) if alike(name, one)]
    return min(near)[1] if near else ""


def likely_program(name: str, valid: list[str]) -> str:
    """Return the program that was likely meant; empty where none is like it.

    It is the one that is most alike, or else one whose name is the same without its ending and words such as ``node``,
    or is a part of it.
    """
    near = nearest_name(name, valid)
    if near:
        return near
    stem = _stem(name)
    others = [(one, _stem(one)) for one in dict.fromkeys(valid) if one != name]
    for fits in (stem.__eq__, lambda other: _is_part(stem, other)):
        found = [(abs(len(one) - len(name)), one) for one, other in others if other and fits(other)]
        if found:
            return min(found)[1]
    return ""


_SAYS_LITTLE = frozenset({"node", "nodelet", "main", "exe", "py", "cpp", "sh", "bash", "the", "ros", "ros2"})
_SHORT = 4


def _stem(name: str) -> str:
    """Return the words of a name that tell it from others."""
    words = re.findall(r"[A-Z]?[a-z0-9]+|[A-Z]+(?![a-z])", name)
    return "_".join(word.lower() for word in words if word.lower() not in _SAYS_LITTLE)


def _is_part(one: str, other: str) -> bool:
    shorter, longer = sorted((one, other), key=len)
    return len(shorter) >= _SHORT and f"_{shorter}_" in f"_{longer}_"
