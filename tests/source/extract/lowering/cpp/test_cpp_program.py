from pathlib import Path

import msgspec
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roslens.source.extract.ir.program import Call, Lambda, Member, Name, Program
from roslens.source.extract.ir.program_text import program_text
from roslens.source.extract.lowering.cpp.cpp_program import lower_cpp, program_of_cpp
from roslens.source.syntax.macro.macros import load_macros
from roslens.source.syntax.query.cpp_query import parse_tree

FIXTURES = Path(__file__).parents[4] / "fixtures" / "extract" / "cpp"
EXPECTED = sorted(FIXTURES.glob("*.txt"))
SOURCES = [path.read_bytes() for path in sorted(FIXTURES.glob("*.cpp"))]
MACROS = load_macros()


def lowered(source: str) -> str:
    return program_text(program_of_cpp(source.encode(), MACROS))


def every(value: object, kind: type) -> list:
    """Return all values of a kind in a program, one that it shares between places once."""
    found, waiting, seen = [], [value], set()
    while waiting:
        one = waiting.pop()
        if id(one) in seen:
            continue
        seen.add(id(one))
        if isinstance(one, kind):
            found.append(one)
        if isinstance(one, msgspec.Struct):
            waiting += [getattr(one, name) for name in one.__struct_fields__]
        elif isinstance(one, tuple):
            waiting += one
        elif isinstance(one, dict):
            waiting += one.values()
    return found


@pytest.mark.parametrize("expected", EXPECTED, ids=lambda path: path.stem)
def test_a_construct_is_lowered_as_written_by_hand(expected: Path) -> None:
    text = expected.read_text()
    program = program_of_cpp(expected.with_suffix(".cpp").read_bytes(), MACROS)
    assert program_text(program, lines=" @" in text) == text


def test_what_does_not_parse_hides_nothing_else() -> None:
    program = program_of_cpp((FIXTURES / "broken.cpp").read_bytes(), MACROS)
    topics = {call.arguments[0].value for call in every(program, Call) if isinstance(call.function, Member)}
    assert topics >= {"before", "after", "second", "third"}
    assert 4 in {line for line, _ in program.incomplete}
    assert program.incomplete == tuple(sorted(program.incomplete))


def test_the_tree_of_another_parse_is_used() -> None:
    source = b"RCLCPP_COMPONENTS_REGISTER_NODE(a::B)\nint x = 3;\n"
    blanked = MACROS.blank(source)
    tree = parse_tree(blanked)
    assert "REGISTER" not in program_text(lower_cpp(blanked, tree))
    assert "REGISTER_NODE(a.B)" in program_text(lower_cpp(blanked, tree, source))
    assert lower_cpp(blanked, tree, source) == program_of_cpp(source, MACROS)


def test_a_long_fall_through_is_cut_and_told() -> None:
    cases = b"".join(b"case %d: f(%d);\n" % (one, one) for one in range(110))
    program = program_of_cpp(b"int main() { nh.subscribe(1); switch (x) {\n" + cases + b"} last(); }", MACROS)
    called = [one for one in every(program, Call) if isinstance(one.function, Name) and one.function.name == "f"]
    assert len({one.line for one in called}) == 110
    assert len(msgspec.msgpack.encode(program)) < 1_000_000
    assert {reason for _, reason in program.incomplete} == {"falls through to more than 100 statements"}


@pytest.mark.parametrize(
    "source",
    [
        b"int main() { nh.subscribe(" + b"(" * 10_000 + b"1" + b")" * 10_000 + b"); last(); }",
        b"int main() { nh.subscribe(1); " + b"f(" * 5_000 + b"1" + b")" * 5_000 + b"; last(); }",
        b"int main() { nh.subscribe(1); " + b"{" * 5_000 + b"f();" + b"}" * 5_000 + b" last(); }",
        b"int main() { nh.subscribe(1); " + b"if (a) f(); else " * 1_000 + b"f(); last(); }",
        b"int main() { nh.subscribe(1); switch (x) {" + b"case 1: f(); " * 1_000 + b"} last(); }",
        b"int main() { x = " + b"a + " * 5_000 + b"subscribe(1); last(); }",
        b"int main() { x = " + b"a - " * 5_000 + b"subscribe(1); last(); }",
        b"int main() { nh" + b".subscribe(1)" * 5_000 + b"; last(); }",
        b"int main() { nh.subscribe(1); " + b"f([] { g(); " * 150 + b"});" * 150 + b" last(); }",
        b"int main() { nh.subscribe(1); " + b"struct A { void f() { g(); " * 100 + b"} };" * 100 + b" last(); }",
        b"namespace a { " * 5_000 + b"int x = 1;" + b"}" * 5_000 + b" void f() { last(); }",
        b"#if A\n" * 1_000 + b"int x = 1;\n" + b"#endif\n" * 1_000 + b"void f() { last(); }",
    ],
    ids=lambda source: source[-60:].decode().strip()[:12] + str(len(source)),
)
def test_deep_nesting_ends_with_a_program(source: bytes) -> None:
    program = program_of_cpp(source, MACROS)
    assert Name("last") in [call.function for call in every(program, Call)]
    assert msgspec.msgpack.decode(msgspec.msgpack.encode(program), type=Program) == program
    assert program_text(program)


HARDLY_SOURCE = (
    *(b"", b"\0", b"\0" * 1000, b"\xff\xfe" + "int x;".encode("utf-16-le"), b"\xef\xbb\xbfint x = 1;", b"f(\xe4);"),
    *(b"(", b"{", b'"', b"#", b"#define", b"#define A", b"#if", b"class", b"template<", b"using", b"namespace", b'R"('),
    b"a" * 100_000,
)


@pytest.mark.parametrize("source", HARDLY_SOURCE, ids=lambda source: source[:12].hex())
def test_bytes_that_are_hardly_source(source: bytes) -> None:
    assert program_of_cpp(source, MACROS).language == "cpp"


def assert_sound(program: Program) -> None:
    assert msgspec.msgpack.decode(msgspec.msgpack.encode(program), type=Program) == program
    assert all(0 <= one.function < len(program.functions) for one in every(program, Lambda))
    assert all(program.functions[one.function].name == "lambda" for one in every(program, Lambda))
    assert all(one.name for one in every(program, Name))
    assert isinstance(program_text(program), str)


@settings(max_examples=150, deadline=None)
@given(st.data())
def test_a_damaged_file_still_gives_a_sound_program(data: st.DataObject) -> None:
    source = bytearray(data.draw(st.sampled_from(SOURCES)))
    for _ in range(data.draw(st.integers(1, 6))):
        start = data.draw(st.integers(0, max(len(source) - 1, 0)))
        end = min(len(source), start + data.draw(st.integers(0, 40)))
        written = st.sampled_from(
            [b"", b"(", b")", b"{", b"}", b"<", b">", b'"', b";", b",", b"::", b"\0", b"\n#if X\n", b"\xff"]
        )
        source[start:end] = data.draw(written)
    assert_sound(program_of_cpp(bytes(source), MACROS))


@settings(max_examples=150, deadline=None)
@given(st.data())
def test_pieces_of_files_put_together_give_a_sound_program(data: st.DataObject) -> None:
    lines = [line for source in SOURCES for line in source.split(b"\n")]
    chosen = data.draw(st.lists(st.sampled_from(lines), max_size=40))
    source = b"void f() {\n" + b"\n".join(chosen) if data.draw(st.booleans()) else b"\n".join(chosen)
    assert_sound(program_of_cpp(source, MACROS))
