"""Facts of whatever comes along: never a crash, and always consistent in themselves.

``ROSLENS_FUZZ_CASES`` says how many cases the slow test takes (10,000 without it).
"""

import os
import random
from collections import Counter
from itertools import pairwise
from pathlib import Path

import msgspec
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roslens.source.syntax.facts import FileFacts
from roslens.source.syntax.python import parse_python

FIXTURES = Path(__file__).parents[2] / "fixtures" / "syntax" / "python"
SEEDS = [path.read_bytes() for path in sorted(FIXTURES.glob("*/*.py"))]
CASES = int(os.environ.get("ROSLENS_FUZZ_CASES", "10000"))
WORDS = (
    b"def class if elif else for while try except finally with match case _ lambda return raise yield await async "
    b"and or not in is import from as global assert del pass print exec a B self f(x) x.y = == := -> * ** @ , : ; . "
    b"( ) [ ] { } ' \" ''' \"\"\" f' r\" \\ # 0 1.5 0777 ` <> \x00 \xe9 \xc3\xa9 \t \r \x0c"
).split(b" ")
PIECES = [*WORDS, b" ", b"\n", b"\n    ", b"\n        ", b"\r\n", b"\\\n"]
NOT_IN_CONTROL = {"call", "recursion", "statement", "catch_group"}


def check(content: bytes) -> FileFacts:
    """Hold the facts of ``content`` against what must be so for any."""
    facts = parse_python(content)
    last = content.count(b"\n") + content.count(b"\r") + 1
    for function in facts.functions:
        assert 1 <= function.line <= function.end_line <= last
        assert function.lines.physical == function.end_line - function.line + 1
        assert function.lines.code + function.lines.comment + function.lines.blank == function.lines.physical
        assert 0 <= function.eloc <= function.lines.physical
        assert min(function.counts.values(), default=1) > 0
        noted = Counter(event.role for event in function.control)
        assert noted == Counter({role: n for role, n in function.counts.items() if role not in NOT_IN_CONTROL})
        for part in (function.lambda_counts, function.aside_counts):
            assert all(0 < number <= function.counts[role] for role, number in part.items())
        depths = [-1, *(event.depth for event in function.control)]
        assert all(0 <= depth <= before + 1 for before, depth in pairwise(depths))
    for one in facts.classes:
        assert 1 <= one.line <= one.end_line <= last
    for fault in facts.faults:
        assert 1 <= fault.line <= fault.end_line <= last
        assert fault.column >= 1
        assert fault.text
    assert list(facts.line_numbers) == sorted(set(facts.line_numbers))
    assert len(facts.line_numbers) == len(facts.line_hashes)
    encoded = msgspec.msgpack.encode(facts)
    assert msgspec.msgpack.decode(encoded, type=FileFacts) == facts
    return facts


@given(st.binary(max_size=300))
@settings(max_examples=150, deadline=None)
def test_any_bytes(content):
    check(content)


@given(st.lists(st.sampled_from(PIECES), max_size=120).map(b" ".join))
@settings(max_examples=150, deadline=None)
def test_any_words(content):
    check(content)


@pytest.mark.parametrize("content", SEEDS)
def test_fixtures_are_consistent(content):
    assert check(content) == check(content)


def mutated(chance: random.Random, seeds: list[bytes]) -> bytes:
    """Return a piece of a seed with some bytes, words or lines changed, doubled, moved or left out."""
    content = bytearray(chance.choice(seeds))
    start = chance.randrange(len(content))
    content = content[start : start + chance.randint(20, 1500)] if chance.random() < 0.5 else content[:1500]
    for _ in range(chance.randint(1, 8)):
        place, length = chance.randrange(len(content) + 1), chance.randint(0, 30)
        kind = chance.randrange(5)
        if kind == 0:
            content[place : place + length] = b""
        elif kind == 1:
            content[place:place] = chance.choice(PIECES)
        elif kind == 2:
            content[place : place + 1] = bytes((chance.randrange(256),))
        elif kind == 3:
            other = chance.choice(seeds)
            cut = chance.randrange(len(other))
            content[place:place] = other[cut : cut + length * 4]
        else:
            content[place:place] = content[place : place + length] * chance.randint(1, 5)
    return bytes(content)


def test_mutated_fixtures():
    chance = random.Random(20)
    for _ in range(300):
        check(mutated(chance, SEEDS))


@pytest.mark.nightly
@pytest.mark.heavy
@pytest.mark.timeout(7200)
def test_many_mutated_fixtures():
    for number in range(CASES):
        chance = random.Random(number)
        content = mutated(chance, SEEDS) if number % 4 else b" ".join(chance.choices(PIECES, k=chance.randint(1, 200)))
        try:
            check(content)
        except AssertionError as error:
            raise AssertionError(f"case {number}: {content!r}") from error
