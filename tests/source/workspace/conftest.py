"""What the tests of the workspace share: fixture manifests, trees of files, a reader held against catkin_pkg."""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import pytest

MANIFESTS = Path(__file__).parents[2] / "fixtures" / "workspaces" / "manifests"

PACKAGE = """<package format="3">
  <name>{name}</name>
  <version>1.0.0</version>
  <description>One of the packages of a test</description>
  <maintainer email="ada@example.org">Ada</maintainer>
  <license>Apache-2.0</license>
</package>
"""

Mutation = tuple[str, int, int, bytes]


@pytest.fixture(scope="session")
def manifests() -> dict[str, bytes]:
    """The fixture manifests by the stem of their file."""
    return {path.stem: path.read_bytes() for path in sorted(MANIFESTS.glob("*.xml"))}


@pytest.fixture
def tree(tmp_path: Path) -> Callable[[Mapping[str, str | bytes]], Path]:
    """Writes files below a fresh folder; the content ``package:NAME`` is a whole manifest, ``link:TARGET`` a link."""

    def write(files: Mapping[str, str | bytes]) -> Path:
        root = tmp_path / "ws"
        for name, content in files.items():
            path = root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            if isinstance(content, str) and content.startswith("package:"):
                path.write_text(PACKAGE.format(name=content.removeprefix("package:")))
            elif isinstance(content, str) and content.startswith("link:"):
                path.symlink_to(content.removeprefix("link:"))
            else:
                path.write_bytes(content.encode() if isinstance(content, str) else content)
        return root

    return write


TOKENS = (
    b"<",
    b">",
    b"&",
    b'"',
    b"</name>",
    b"</package>",
    b"<package>",
    b"<name>",
    b"<depend>",
    b"<export>",
    b"<build_type>",
    b"<!--",
    b"-->",
    b"<![CDATA[",
    b"]]>",
    b"<?x",
    b"?>",
    b"&#0;",
    b"&#xD800;",
    b"&amp;",
    b"&foo;",
    b'<!DOCTYPE a [<!ENTITY b "c">]>',
    b'<!DOCTYPE a SYSTEM "file:///dev/zero">',
    b"\0",
    b"\xff\xfe",
    b"\xef\xbb\xbf",
    b"\xe4",
    b"\xed\xa0\x80",
    b"\r\n",
    b' condition="((((("',
    b' condition="$A =="',
    b' condition="$A == b"',
    b' format="9"',
    b' encoding="utf-16"',
    b' encoding="shift_jis"',
    b"<a>" * 80,
    b"\n" * 500,
    b"a" * 3000,
)

OPERATIONS = ("delete", "double", "insert", "token", "flip")


def mutated(content: bytes, mutations: Sequence[Mutation]) -> bytes:
    """Apply mutations one after the other; positions wrap around."""
    for operation, at, length, token in mutations:
        size = len(content) + 1
        start, end = at % size, min(len(content), at % size + length)
        if operation == "delete":
            content = content[:start] + content[end:]
        elif operation == "double":
            content = content[:end] + content[start:end] + content[end:]
        elif operation == "flip":
            content = (
                content[:start]
                + bytes(byte ^ (length or 1) for byte in content[start : start + 1])
                + content[start + 1 :]
            )
        else:
            content = content[:start] + token + content[start:]
    return content


def some_mutations(generator: random.Random) -> list[Mutation]:
    """Draw one to six mutations."""
    return [
        (
            generator.choice(OPERATIONS),
            generator.randrange(1 << 16),
            generator.choice((1, 1, 2, 5, 20, 100, 255)),
            generator.choice(TOKENS),
        )
        for _ in range(generator.randint(1, 6))
    ]


@pytest.fixture(scope="session")
def mutate() -> Callable[[bytes, Sequence[Mutation]], bytes]:
    return mutated


@pytest.fixture(scope="session")
def draw_mutations() -> Callable[[random.Random], list[Mutation]]:
    return some_mutations
