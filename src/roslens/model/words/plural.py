"""A number with its noun, as messages say it."""

from __future__ import annotations


def plural(count: int, one: str, many: str = "") -> str:
    """Return ``1 package``, ``1,200 packages``.

    Args:
        count: how many there are.
        one: the noun, or the words, for one of them.
        many: the words for any other number; with an ``s`` behind where empty.
    """
    return f"{count:,} {one if count == 1 else many or one + 's'}"
