"""Commands, arguments and blocks of CMake files."""

import re
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roslens.source.extract.builds.cmake_syntax import (
    MOST_FAULTS,
    MOST_NESTING,
    Block,
    Command,
    Reference,
    parse_cmake,
    template_of,
)

ROOT = Path(__file__).parents[3] / "fixtures" / "extract" / "cmake"
REAL = [
    path.read_bytes() for path in sorted(ROOT.rglob("*")) if path.suffix == ".cmake" or path.name == "CMakeLists.txt"
]


def only(content):
    (found,) = parse_cmake(content).body
    return found


def written(command):
    return [(one.kind, one.written) for one in command.arguments]


def test_a_command_knows_its_place():
    script = parse_cmake(b"# first\nset(A)\n  Add_Library( foo\n a.cpp)\n")
    assert [(one.name, one.line, one.column) for one in script.body] == [("set", 2, 1), ("add_library", 3, 3)]


def test_kinds_of_arguments():
    found = only(b'set(a "b c" [=[d]]e]=] -DX="y z" f\\ g (h))')
    assert written(found) == [
        ("bare", "a"), ("quoted", '"b c"'), ("bracket", "[=[d]]e]=]"), ("bare", '-DX="y z"'), ("bare", "f\\ g"),
        ("paren", "("), ("bare", "h"), ("paren", ")"),
    ]  # fmt: skip


def test_comments_are_left_out():
    assert written(only(b"set(a # ) \n#[[ ) ]] b #[==[ ]] ]==]\n c)")) == [("bare", "a"), ("bare", "b"), ("bare", "c")]


def test_references_nest():
    assert template_of("x${a${b}}$ENV{HOME}y") == (
        "x",
        Reference("", ("a", Reference("", ("b",)))),
        Reference("ENV", ("HOME",)),
        "y",
    )


@pytest.mark.parametrize("text", ["${a", "a}", "$", "$ENV", "$<X:y>", "a$b", "{}"])
def test_what_is_no_reference_is_text(text):
    assert template_of(text) == (text,)


def test_escapes():
    assert template_of(r"a\tb\"c\${d}\;e\\") == ('a\tb"c${d}\\;e\\',)


def test_blocks():
    (block,) = parse_cmake(b"if(A)\nx()\nelseif(B)\nelse()\nforeach(i)\ny()\nendforeach()\nendif(A)").body
    assert isinstance(block, Block)
    assert [(opened.name, len(body)) for opened, body in block.branches] == [("if", 1), ("elseif", 0), ("else", 1)]
    inner = block.branches[2][1][0]
    assert isinstance(inner, Block)
    assert inner.branches[0][0].name == "foreach"


@pytest.mark.parametrize(
    ("content", "what", "names"),
    [
        (b'set(a "b)\nx()\n', "an argument does not end", ["x"]),
        (b"set(a\n", "a command does not end", []),
        (b"!!! x\ny()", '"!!! x" is not a command', ["y"]),
        (b"#[[ never\nz()", "a bracket comment does not end", ["z"]),
        (b"set([[ never)\nz()", "an argument does not end", ["z"]),
        (b"endif()\nz()", '"endif" has no opening command', ["z"]),
        (b"if(A)\nz()", '"if" has no "endif"', ["if"]),
        (b"if(A)\nforeach(b)\nendif()\nz()", '"foreach" has no "endforeach"', ["if", "z"]),
    ],
)
def test_faults_cost_themselves_alone(content, what, names):
    script = parse_cmake(content)
    assert [fault.what for fault in script.faults] == [what]
    assert [one.name if isinstance(one, Command) else one.branches[0][0].name for one in script.body] == names


def test_deep_nesting_is_left_out():
    script = parse_cmake(b"if(A)\n" * 10_000 + b"x()\n" + b"endif()\n" * 10_000 + b"after()")
    assert script.body[-1].name == "after"
    assert script.faults[0].what == f"more than {MOST_NESTING} blocks are nested"
    parse_cmake(b"set(" + b"${" * 10_000 + b")")
    parse_cmake(b"set(" + b"(" * 10_000 + b")" * 10_000 + b")")


@pytest.mark.parametrize("sign", [b'"', b"[[", b"#[[", b"$(", b"(", b'a"', b"\\", b"${"])
def test_repeated_signs_end_soon(sign):
    script = parse_cmake(b"set(" + sign * 50_000)
    assert len(script.faults) <= MOST_FAULTS


@settings(max_examples=150, deadline=None)
@given(st.binary(max_size=200))
def test_any_bytes_are_read(content):
    script = parse_cmake(content)
    assert len(script.faults) <= MOST_FAULTS


@settings(max_examples=150, deadline=None)
@given(st.sampled_from(REAL), st.data())
def test_mutated_files_are_read(content, data):
    for _ in range(data.draw(st.integers(1, 5))):
        at = data.draw(st.integers(0, len(content)))
        gone = data.draw(st.integers(0, 5))
        content = (
            content[:at]
            + data.draw(st.sampled_from([b"", b'"', b"(", b")", b"${", b"[[", b"#", b"\0"]))
            + content[at + gone :]
        )
    parse_cmake(content)


@given(st.lists(st.from_regex(re.compile(r"[A-Za-z0-9_./-]+", re.ASCII), fullmatch=True), max_size=6))
def test_plain_arguments_come_back(values):
    found = only(f"set({' '.join(values)})".encode())
    assert [one.literal for one in found.arguments] == values
