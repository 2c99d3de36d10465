"""Sources as lines: counted as analysers count them, coloured, cut into excerpts, told when they changed."""

from __future__ import annotations

from roslens.dashboard.sources.source_text import LONGEST_LINE, Sources, blob_id, lines_of
from roslens.model.source import Language, SourceFile

CODE = b"int a;\r\n// \xc3\xa9\nint b = 1;\n\nreturn b;\n"


def sources(content: bytes | None, known: bytes = CODE) -> Sources:
    file = SourceFile("a.cpp", Language.CPP, size=len(known), content_hash=blob_id(known))
    return Sources(lambda _: content, lambda path: file if path == "a.cpp" else None)


def test_only_a_line_feed_ends_a_line() -> None:
    assert lines_of(CODE) == ("int a;", "// é", "int b = 1;", "", "return b;")
    assert lines_of(b"a\x0cb\rc\nd") == ("a\x0cb c", "d")
    assert lines_of(b"") == ()
    assert lines_of(b"\xef\xbb\xbfint a;") == ("int a;",)
    assert lines_of(b"\xff\x00")[0][0] == "\N{REPLACEMENT CHARACTER}"


def test_a_line_that_no_screen_holds_is_cut_and_says_so() -> None:
    (line,) = lines_of(b"x" * 5000)
    assert line.endswith(f"[{5000 - LONGEST_LINE:,} more characters]")


def test_an_excerpt_holds_the_lines_around() -> None:
    found = sources(CODE).excerpt("a.cpp", 3)
    assert found is not None
    assert [(number, hit) for number, hit, _ in found.lines] == [
        (1, False), (2, False), (3, True), (4, False), (5, False),
    ]  # fmt: skip
    assert not found.changed


def test_a_long_finding_is_cut_to_a_few_lines() -> None:
    content = b"x\n" * 100
    found = sources(content, content).excerpt("a.cpp", 10, 90)
    assert found is not None
    assert sum(hit for _, hit, _ in found.lines) == 8


def test_a_place_that_is_not_there_has_no_excerpt() -> None:
    assert sources(CODE).excerpt("a.cpp", 0) is None
    assert sources(CODE).excerpt("a.cpp", 6) is None
    assert sources(None).excerpt("a.cpp", 1) is None


def test_a_file_that_is_no_longer_what_the_run_saw_is_told() -> None:
    text = sources(CODE + b"int c;\n").text("a.cpp")
    assert text is not None
    assert text.changed
