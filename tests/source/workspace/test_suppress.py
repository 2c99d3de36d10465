"""Comments that ask to leave findings out."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pace import soon

from roslens.source.workspace.suppress import Suppression, suppressed, suppressions


def only(content: bytes) -> Suppression:
    found = suppressions(content)
    assert len(found) == 1
    return found[0]


@pytest.mark.parametrize(
    ("comment", "rules", "reason", "lines"),
    [
        (b"int a;  // roslens: ignore", (), "", (2, 2)),
        (b"int a;  // roslens:ignore[complexity]", ("complexity",), "", (2, 2)),
        (b"a = 1  # roslens: ignore[a.b, c] a table", ("a.b", "c"), "a table", (2, 2)),
        (b"/* roslens: ignore-next-line[x] why not */", ("x",), "why not", (3, 3)),
        (b"<!-- roslens: ignore[x] -->", ("x",), "", (2, 2)),
        (b" * roslens: ignore[x]", ("x",), "", (2, 2)),
        (b"// haros:ignore-line", (), "", (2, 2)),
        (b"# haros:ignore-next-line", (), "", (3, 3)),
        (b"int a;  // NOLINT", (), "", (2, 2)),
        (b"int a;  // NOLINT(runtime/int, build/include) - old", ("runtime/int", "build/include"), "old", (2, 2)),
        (b"// NOLINTNEXTLINE(a-b-*)", ("a-b-*",), "", (3, 3)),
        (b"// cppcheck-suppress nullPointer // why", ("nullPointer",), "", (2, 3)),
        (b"// cppcheck-suppress [a, b]", ("a", "b"), "", (2, 3)),
        (b"import x  # noqa", (), "", (2, 2)),
        (b"import x  # noqa: E501,F401 it is so", ("E501", "F401"), "it is so", (2, 2)),
        (b"import x  # noqa:E501 F401\r", ("E501", "F401"), "", (2, 2)),
        (b"import x  # type: ignore  # noqa: E501", ("E501",), "", (2, 2)),
    ],
)
def test_spellings(comment: bytes, rules: tuple[str, ...], reason: str, lines: tuple[int, int]) -> None:
    found = only(b"first\n" + comment + b"\nlast\n")
    assert (found.rules, found.reason) == (rules, reason)
    assert (found.line, found.end_line) == lines
    assert found.comment == 2


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"int a;",
        b'print("NOLINT")',
        b"roslens: ignore",
        b"// roslens: ignored",
        b"// roslens: ignore-file-size",
        b"// roslens: ignore[]",
        b"// myNOLINT",
        b"// cppcheck-suppress",
        b"# type: ignore",
        b"// ignore haros",
    ],
)
def test_what_is_none(content: bytes) -> None:
    assert suppressions(content) == ()


def test_blocks() -> None:
    content = (
        b"// NOLINTBEGIN(a)\nx\n// NOLINTBEGIN\ny\n// NOLINTEND\n// NOLINTEND(a)\n// NOLINTEND\n// NOLINTBEGIN(b)\nz"
    )
    assert [(one.line, one.end_line, one.rules) for one in suppressions(content)] == [
        (1, 6, ("a",)),
        (3, 5, ()),
        (8, 9, ("b",)),
    ]


def test_blocks_and_files_of_our_own() -> None:
    content = b"x\n// roslens: ignore-begin[a] why\ny\n// roslens: ignore-end\nz // roslens: ignore-file[b] generated\n"
    block, file = suppressions(content)
    assert (block.line, block.end_line, block.rules, block.reason) == (2, 4, ("a",), "why")
    assert (file.rules, file.reason, file.comment) == (("b",), "generated", 5)
    assert [line for line in range(7) if suppressed("b", (), line, [file])] == [0, 1, 2, 3, 4, 5, 6]
    (open_,) = suppressions(b"// roslens: ignore-begin[a]\n// NOLINTEND\nz")
    assert (open_.line, open_.end_line) == (1, 3)


def test_two_on_one_line() -> None:
    content = b"int a;  // NOLINT(a) see http://x.org // roslens: ignore[b] because\n"
    assert [(one.rules, one.reason) for one in suppressions(content)] == [
        (("a",), "see http://x.org"),
        (("b",), "because"),
    ]


@pytest.mark.parametrize(
    ("name", "rule", "tags", "covered"),
    [
        ("cpplint.runtime/int", "cpplint.runtime/int", (), True),
        ("runtime/int", "cpplint.runtime/int", (), True),
        ("int", "cpplint.runtime/int", (), True),
        ("nt", "cpplint.runtime/int", (), False),
        ("style", "cpplint.runtime/int", ("style",), True),
        ("cpplint.*", "cpplint.runtime/int", (), True),
        ("runtime/*", "cpplint.runtime/int", (), True),
        ("build/*", "cpplint.runtime/int", (), False),
        ("E501", "ruff:E501", (), True),
    ],
)
def test_names(name: str, rule: str, tags: tuple[str, ...], covered: bool) -> None:
    assert suppressed(rule, tags, 7, [Suppression(7, (name,), end_line=7)]) is covered


def test_lines() -> None:
    known = suppressions(b"a\n// NOLINTNEXTLINE\nb\nc // roslens: ignore[x]\n")
    assert [line for line in range(1, 6) if suppressed("x", (), line, known)] == [3, 4]
    assert [line for line in range(1, 6) if suppressed("y", (), line, known)] == [3]
    assert not suppressed("y", (), 3, ())


@given(
    parts=st.lists(
        st.sampled_from(
            (b"// ", b"NOLINT", b"NOLINTBEGIN", b"noqa", b": ", b"[", b"]", b"(", b")", b"a,", b"\n", b"# ")
        )
        | st.sampled_from(
            (b"roslens: ignore", b"-next-line", b"haros:ignore-line", b"cppcheck-suppress ", b"\xe4", b"\0")
        ),
        max_size=30,
    )
)
@settings(max_examples=200, deadline=None)
def test_any_comment_is_answered(parts: list[bytes]) -> None:
    content = b"".join(parts)
    lines = content.count(b"\n") + 1
    for one in suppressions(content):
        assert 1 <= one.comment <= lines
        assert one.comment <= one.line <= one.end_line <= lines + 2


@pytest.mark.parametrize(
    "content",
    [
        b"#" * 2_000_000 + b"NOLINT",
        b"// NOLINT" * 200_000,
        b"# noqa: " + b"A1 " * 300_000,
        b"roslens: ignore[" * 100_000,
        b"# noqa:" + b" ," * 500_000,
    ],
)
def test_long_lines_take_no_time(content: bytes) -> None:
    with soon(30):
        assert len(suppressions(content)) <= 200_000
