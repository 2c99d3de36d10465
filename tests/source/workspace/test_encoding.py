"""What is reported about the bytes of a source file."""

from __future__ import annotations

import pytest

from roslens.source.workspace.encoding import Encoding, encoding_failure, encoding_of


@pytest.mark.parametrize(
    ("content", "encoding"),
    [
        (b"", Encoding("ascii")),
        (b"int a;\n", Encoding("ascii")),
        (b"int a;\r\n", Encoding("ascii", crlf=True)),
        ("// ü\n".encode(), Encoding("utf-8")),
        (b"\xef\xbb\xbfint a;\n", Encoding("utf-8", bom=True)),
        (b"a\n// \xfc\n", Encoding("latin-1", odd_line=2, odd_column=4)),
        (b"int a;\n" * 9 + b"x\0", Encoding("ascii", zero_bytes=1, odd_line=10, odd_column=2)),
        ("int a;".encode("utf-16"), Encoding("utf-16", bom=True, odd_line=1, odd_column=1)),
        (b"\x7fELF\0\0\0\0", Encoding("binary", zero_bytes=4, odd_line=1, odd_column=5)),
    ],
)
def test_encodings(content: bytes, encoding: Encoding) -> None:
    assert encoding_of(content) == encoding


@pytest.mark.parametrize("content", [b"", b"a\r\n", "ü".encode(), b"\xfc", b"\xef\xbb\xbfa"])
def test_nothing_to_tell(content: bytes) -> None:
    assert encoding_failure("a.cpp", content) is None


@pytest.mark.parametrize(
    ("content", "message", "partial"),
    [
        ("ab".encode("utf-16-le"), "a.cpp:1:2: the file is binary, 2 of 4 bytes are zero; expected source text", False),
        ("ab".encode("utf-16"), "a.cpp:1:1: the file is UTF-16; expected source in UTF-8", False),
        (b"int abcdefghi;\n\0", "a.cpp:2:1: the file contains 1 zero byte; expected source text", True),
    ],
)
def test_what_is_told(content: bytes, message: str, partial: bool) -> None:
    failure = encoding_failure("a.cpp", content)
    assert failure is not None
    assert str(failure).startswith(message)
    assert failure.partial is partial
    assert failure.advice
