"""The valid word that a wrong one was probably meant to be."""

from __future__ import annotations

from collections.abc import Iterable

_ALIKE = 0.6
"""Least likeness (Ratcliff and Obershelp) of words that are named."""


def nearest(word: str, valid: Iterable[str]) -> str:
    """Return the valid word most like ``word``, or an empty text where none is alike."""
    import difflib

    found = difflib.get_close_matches(word, sorted(valid), 1)
    return found[0] if found else ""


def nearest_few(word: str, valid: Iterable[str]) -> list[str]:
    """Return at most three valid words like ``word``, the most alike first."""
    import difflib

    return difflib.get_close_matches(word, sorted(valid), 3, _ALIKE)


def did_you_mean(word: str, valid: Iterable[str]) -> str:
    """Return the advice ``Did you mean x?``, or an empty text."""
    found = nearest(word, valid)
    return f"Did you mean {found!r}?" if found else ""
