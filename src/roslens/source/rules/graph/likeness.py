"""How alike two names are: the number of typing mistakes between them."""

from __future__ import annotations


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
