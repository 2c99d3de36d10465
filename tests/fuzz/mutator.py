"""Files made of others: bytes flipped, cut, doubled and spliced, and words put in that mean something to a reader."""

from __future__ import annotations

import random
from collections.abc import Sequence

MOST_BYTES = 20_000
"""Longer cases are cut; sizes have tests of their own."""
_NUMBERS = (0, 1, 0x7F, 0x80, 0xFF, 0x7FFF, 0xFFFF, 0x7FFFFFFF, 0xFFFFFFFF, 0x7FFFFFFFFFFFFFFF, 0xFFFFFFFFFFFFFFFF)


def mutated(chance: random.Random, seeds: Sequence[bytes], words: Sequence[bytes]) -> bytes:
    """Return one of the seeds after one to eight changes."""
    text = bytearray(chance.choice(seeds))
    for _ in range(chance.randint(1, 8)):
        start = chance.randrange(len(text) + 1)
        end = min(len(text), start + min(chance.randint(1, 8) ** chance.randint(1, 3), 400))
        _CHANGES[chance.randrange(len(_CHANGES))](chance, text, start, end, seeds, words)
    return bytes(text[:MOST_BYTES])


def _cut(_chance, text, start, end, _seeds, _words):
    del text[start:end]


def _double(chance, text, start, end, _seeds, _words):
    text[start:start] = text[start:end] * chance.choice((1, 1, 1, 2, 40))


def _flip(chance, text, start, _end, _seeds, _words):
    if start < len(text):
        text[start] ^= 1 << chance.randrange(8)


def _byte(chance, text, start, _end, _seeds, _words):
    text[start : start + 1] = bytes([chance.randrange(256)])


def _splice(chance, text, start, end, seeds, _words):
    other = chance.choice(seeds)
    place = chance.randrange(len(other) + 1)
    text[start:end] = other[place : place + chance.randint(1, 300)]


def _word(chance, text, start, end, _seeds, words):
    text[start : chance.choice((start, end))] = chance.choice(words)


def _number(chance, text, start, _end, _seeds, _words):
    size = chance.choice((1, 2, 4, 8))
    value = (chance.choice(_NUMBERS) + chance.randint(-1, 1)) % (1 << 8 * size)
    text[start : start + size] = value.to_bytes(size, chance.choice(("little", "big")))


def _move(chance, text, start, end, _seeds, _words):
    piece = text[start:end]
    del text[start:end]
    place = chance.randrange(len(text) + 1)
    text[place:place] = piece


def _end(chance, text, start, _end, _seeds, _words):
    if chance.random() < 0.2:
        del text[start:]


_CHANGES = (_cut, _double, _flip, _byte, _splice, _splice, _word, _word, _number, _move, _end)
