"""Whole files of Python as small programs, against what they say by hand."""

import ast
import os
import random
from pathlib import Path

import msgspec
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import roslens
from roslens.source.extract.ir.program import Call, Literal, Program
from roslens.source.extract.ir.program_text import program_text
from roslens.source.extract.lowering.python.python_program import lower_python, program_of_python
from roslens.source.syntax.python import parse_python
from roslens.source.syntax.python_tree import parse_tree

FIXTURES = Path(__file__).parents[4] / "fixtures"
OWN = sorted((Path(roslens.__file__).parent / "source").rglob("*.py"))[:: 1 if os.environ.get("ROSLENS_NIGHTLY") else 8]
FILES = sorted((FIXTURES / "extract" / "python").glob("*.txt"))
SEEDS = [
    path.read_bytes()
    for folder in (FIXTURES / "extract" / "python", FIXTURES / "syntax" / "python")
    for path in sorted(folder.rglob("*.py"))
]
PIECES = [
    *b"def class if elif else for while try except with match case lambda return yield await async and or not in is "
    b"import from as global pass print self f(x) x.y = == := -> * ** @ , : ; . ( ) [ ] { } ' \" ''' f'{a} {b!r:>3}' "
    b"%s % .format( \\ # 0777 1e999 ` \x00 \xe9 \xc3\xa9 \t \r".split(b" "),
    b" ",
    b"\n",
    b"\n    ",
    b"\n        ",
]


def check(content: bytes) -> Program:
    """Hold a program against what must be so for any."""
    program = program_of_python(content)
    encoded = msgspec.msgpack.encode(program)
    assert msgspec.msgpack.decode(encoded, type=Program) == program
    last = content.count(b"\n") + content.count(b"\r") + 1
    for function in program.functions:
        assert 1 <= function.line <= last
        assert function.qualified_name.endswith(function.name)
    for line, reason in program.incomplete:
        assert 1 <= line <= last
        assert reason
    assert isinstance(program_text(program, lines=True), str)
    return program


def test_there_are_fixtures():
    assert len(FILES) >= 3


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_file(path):
    program = check(path.with_suffix(".py").read_bytes())
    assert program_text(program) == path.read_text()


def test_of_the_shared_tree():
    content = SEEDS[0]
    assert lower_python(parse_tree(content)) == program_of_python(content)


def test_what_is_broken_leaves_the_rest():
    program = check((FIXTURES / "extract" / "python" / "broken.py").read_bytes())
    text = program_text(program)
    assert 'pub = rospy->Publisher("a", String)' in text
    assert 'rospy->Subscriber("b", String, cb)' in text
    assert 'last = rospy->Publisher("z", String)' in text
    assert {line for line, _ in program.incomplete} & {5, 8}


def test_modules_are_those_of_the_facts():
    for content in SEEDS:
        facts = parse_python(content)
        if not facts.faults:
            assert sorted(program_of_python(content).includes) == sorted(facts.includes)


def test_functions_and_classes_are_those_of_the_facts():
    for content in SEEDS:
        facts = parse_python(content)
        if facts.faults:
            continue
        program = program_of_python(content)
        named = [function for function in program.functions if function.name != "lambda"]
        assert [function.qualified_name for function in named] == [one.qualified_name for one in facts.functions]
        assert [one.qualified_name for one in program.classes] == [one.qualified_name for one in facts.classes]


def found_in(program: Program) -> tuple[set[tuple[int, int]], set[object]]:
    """Return the places of all calls and the values of all literals."""
    places, values = set(), set()
    left = [program.functions, program.classes, program.body]
    while left:
        one = left.pop()
        if isinstance(one, Call) and one.line:
            places.add((one.line, one.column))
        if isinstance(one, Literal):
            values.add(one.value)
        if isinstance(one, tuple):
            left.extend(one)
        elif isinstance(one, msgspec.Struct):
            left.extend(getattr(one, field) for field in one.__struct_fields__)
    return places, values


def is_format(call: ast.Call) -> bool:
    return isinstance(call.func, ast.Attribute) and call.func.attr == "format"


@pytest.mark.parametrize("path", OWN, ids=lambda path: path.stem)
def test_every_call_and_the_texts_that_it_is_given_are_kept(path):
    content = path.read_bytes()
    places, values = found_in(program_of_python(content))
    every = list(ast.walk(ast.parse(content)))
    calls = [node for node in every if isinstance(node, ast.Call)]
    deleted = {(node.lineno, 0) for node in every if isinstance(node, ast.Delete)}
    assert {(call.lineno, call.col_offset + 1) for call in calls if not is_format(call)} <= places
    assert places <= {(call.lineno, call.col_offset + 1) for call in calls} | deleted
    given = [one for call in calls for one in [*call.args, *(keyword.value for keyword in call.keywords)]]
    constants = {one.value for one in given if isinstance(one, ast.Constant) and isinstance(one.value, (str, int))}
    assert constants <= values


def nested(before: str, after: str, middle: str = "x") -> bytes:
    return (before * 3000 + middle + after * 3000).encode()


@pytest.mark.parametrize(
    "content",
    [
        nested("(", ")"),
        nested("f(", ")"),
        nested("[", "]"),
        nested("", ".a()"),
        nested("", " + x"),
        nested("not ", ""),
        nested("lambda: ", ""),
        nested("[a for a in ", "]"),
        b"x" + b" if c else x" * 3000,
        b"if a: f()\n" + b"elif a: f()\n" * 3000,
        b"match a:\n" + b"  case 1: f()\n" * 3000,
        b"try: f()\n" + b"except A: f()\n" * 3000,
        b"".join(
            b" " * depth + b"try: f()\n" + (b" " * depth + b"except A: f()\n") * 40 + b" " * depth + b"except:\n"
            for depth in range(60)
        )
        + b" " * 60
        + b"a"
        + b".a" * 90
        + b"()\n",
        b"".join(b" " * depth + b"if a:\n" for depth in range(500)) + b" " * 500 + b"f()\n",
        b"a = [x" + b" for x in y" * 3000 + b"]",
        b"a = [" + b"f(), " * 3000 + b"]",
        b"a = " * 3000 + b"1",
    ],
    ids=range(17),
)
def test_depth_is_limited(content):
    assert check(content)


def test_too_deep_is_told():
    assert check(nested("f(", ")")).incomplete == ((1, "nested more than 100 levels deep"),)
    assert check(b"a = [" + b"1, " * 501 + b"]").incomplete == ((1, "more than 500 items"),)


@given(st.binary(max_size=300))
@settings(max_examples=100, deadline=None)
def test_any_bytes(content):
    check(content)


@given(st.lists(st.sampled_from(PIECES), max_size=120).map(b" ".join))
@settings(max_examples=150, deadline=None)
def test_any_words(content):
    check(content)


def mutated(chance: random.Random) -> bytes:
    """Return a piece of a fixture with some bytes or words left out, doubled, put in or changed."""
    content = bytearray(chance.choice(SEEDS))
    start = chance.randrange(len(content))
    content = content[start : start + chance.randint(20, 1500)] if chance.random() < 0.5 else content[:1500]
    for _ in range(chance.randint(1, 8)):
        place, length = chance.randrange(len(content) + 1), chance.randint(0, 30)
        kind = chance.randrange(4)
        if kind == 0:
            content[place : place + length] = b""
        elif kind == 1:
            content[place:place] = chance.choice(PIECES)
        elif kind == 2:
            content[place : place + 1] = bytes((chance.randrange(256),))
        else:
            content[place:place] = content[place : place + length] * chance.randint(1, 5)
    return bytes(content)


def test_mutated_fixtures():
    chance = random.Random(30)
    for _ in range(300):
        check(mutated(chance))


@pytest.mark.nightly
@pytest.mark.heavy
@pytest.mark.timeout(3600)
def test_many_mutated_fixtures():
    for number in range(10_000):
        content = mutated(random.Random(number))
        try:
            check(content)
        except Exception as error:
            raise AssertionError(f"case {number}: {content!r}") from error
