"""Tokens of a file cut at the bounds of its functions: split and looked up once for the file and all functions in it.

What is between two bounds is a slice. A bound that would divide a token
is left out, so that a file has the tokens that :func:`~roslens.source.syntax.tokens.halstead_of` finds.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from roslens.source.syntax.facts import Halstead
from roslens.source.syntax.tokens import KEYWORDS, OPERATORS, TokenText, halstead_of, word_counts, words_of

_BETWEEN_WORDS = frozenset(b" ")
_BETWEEN_MARKS = frozenset(b" \t(){}[];,")
"""Marks that are no part of a longer operator stand as well as white space."""


class TokenCuts:
    """The tokens of a text, for counting between given bounds."""

    def __init__(self, text: TokenText, bounds: Iterable[int]) -> None:
        """Split ``text`` at those of ``bounds`` that divide no token."""
        self._text = text
        cuts = sorted({0, *bounds, len(text.code)})
        self._words, self._word_places = _split(text.words, cuts, _BETWEEN_WORDS)
        self._runs, self._run_places = _split(text.marks, cuts, _BETWEEN_MARKS)
        self._keywords = KEYWORDS[text.syntax]
        self._are_keywords = bytes(map(self._keywords.__contains__, self._words))
        self._lengths = list(map(len, map(OPERATORS.__getitem__, self._runs)))

    def words(self, start: int, end: int) -> list[bytes]:
        """Return the words between two offsets."""
        first, last = self._word_places.get(start), self._word_places.get(end)
        if first is None or last is None:
            return words_of(self._text, start, end)
        return self._words[first:last]

    def halstead(self, start: int, end: int) -> Halstead:
        """Count operators and operands between two offsets."""
        first, last = self._word_places.get(start), self._word_places.get(end)
        first_run, last_run = self._run_places.get(start), self._run_places.get(end)
        if first is None or last is None or first_run is None or last_run is None:
            return halstead_of(self._text, word_counts(self._text, start, end), start, end)
        words = set(self._words[first:last])
        keywords = len(words & self._keywords)
        keyword_total = self._are_keywords.count(True, first, last)
        runs = set(self._runs[first_run:last_run])
        operators: set[bytes] = set().union(*map(OPERATORS.__getitem__, runs))
        return Halstead(
            keywords + len(operators),
            len(words) - keywords,
            keyword_total + sum(self._lengths[first_run:last_run]),
            last - first - keyword_total,
        )


def _split(text: bytes, cuts: Sequence[int], between: frozenset[int]) -> tuple[list[bytes], Mapping[int, int]]:
    """Return what white space parts, and how much of that stands before each cut that divides nothing."""
    found: list[bytes] = []
    places = {0: 0}
    done = 0
    end = len(text)
    for cut in cuts:
        if cut >= end or (cut and (text[cut - 1] in between or text[cut] in between)):
            found += text[done:cut].split()
            places[cut] = len(found)
            done = cut
    return found, places
