"""Whatever the bytes are, parsing C++ ends, and what it says stays inside the file."""

import os
import random
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from roslens.source.syntax.cpp import parse_cpp
from roslens.source.syntax.macro.macros import load_macros

FIXTURES = Path(__file__).parents[2] / "fixtures" / "syntax" / "cpp"
CASES = int(os.environ.get("ROSLENS_FUZZ_CASES", "5000"))
FEW = 300
MACROS = load_macros()
SEEDS = [path.read_bytes() for path in sorted(FIXTURES.glob("*/source.*"))]
TOKEN_TEXT = r"""{ } ( ) [ ] < > ; : :: , . -> = == && || & * ! ? ~ # + - ... " ' // /* */ \ int void auto a b f std::x
1 0x1F if else for while do switch case default: try catch return throw break continue goto class struct union namespace
template typename operator new delete public: private: static virtual override const noexcept friend using typedef enum
extern "C" [&] #if #ifdef #else #elif #endif #define #include <a.h> TEST TEST_F BOOST_FOREACH Q_OBJECT signals
slots emit MY_EXPORT PLUGINLIB_EXPORT_CLASS R"( )" 'x' and or not co_await requires concept"""
TOKENS = [*TOKEN_TEXT.split(), "\n", "\\\n", "\0", "\xff"]


def check(content):
    """Assert what holds of the facts of any bytes."""
    facts = parse_cpp(content, MACROS)
    last = content.count(b"\n") + 1
    for one in (*facts.functions, *facts.classes):
        assert one.name
        assert 1 <= one.line <= one.end_line <= last
        assert one.column >= 1
    for fault in facts.faults:
        assert 1 <= fault.line <= fault.end_line <= last
    for function in facts.functions:
        assert 0 <= function.eloc <= function.lines.physical
        assert all(event.depth >= 0 for event in function.control)
        for part in (function.lambda_counts, function.alternative_counts):
            assert all(0 < number <= function.counts.get(role, 0) for role, number in part.items())
    assert len(facts.line_hashes) == len(facts.line_numbers)


def mutated(random_, seeds=SEEDS):
    """Return a seed with a few bytes flipped, cut, doubled or spliced with another seed."""
    text = bytearray(random_.choice(seeds))
    for _ in range(random_.randint(1, 6)):
        start = random_.randrange(len(text) + 1)
        end = min(len(text), start + random_.randint(1, 40))
        change = random_.randrange(6)
        if change == 0:
            del text[start:end]
        elif change == 1:
            text[start:start] = text[start:end]
        elif change == 2 and text:
            text[min(start, len(text) - 1)] = random_.randrange(256)
        elif change == 3:
            other = random_.choice(seeds)
            place = random_.randrange(len(other))
            text[start:end] = other[place : place + random_.randint(1, 200)]
        elif change == 4:
            text[start:start] = random_.choice(TOKENS).encode("utf-8", "replace")
        else:
            del text[start:]
    return bytes(text)


@settings(max_examples=FEW, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(st.lists(st.sampled_from(TOKENS), max_size=80).map(" ".join))
def test_any_tokens(text):
    check(text.encode())


@settings(max_examples=FEW, deadline=None)
@given(st.binary(max_size=300))
def test_any_bytes(content):
    check(content)


def test_mutated_sources():
    random_ = random.Random(20)
    for _ in range(FEW):
        check(mutated(random_))


@pytest.mark.nightly
@pytest.mark.heavy
@pytest.mark.timeout(7200)
def test_many_mutated_sources():
    random_ = random.Random(21)
    for _ in range(CASES):
        check(mutated(random_))
