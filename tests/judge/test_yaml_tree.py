"""YAML as a tree with places: what is read, what is refused and where."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.judge.documents.yaml_tree import MAX_BYTES, Items, Scalar, Table, Tree, read_tree
from roslens.model.errors import DocumentError


def test_nodes_know_their_place():
    tree = read_tree(b"name: x\nlist:\n  - a\n  - {k: 'v'}\n", "m.yaml")
    assert isinstance(tree.root, Table)
    assert (tree.root.keys["list"].line, tree.root.keys["list"].column) == (2, 0)
    items = tree.root.nodes["list"]
    assert isinstance(items, Items)
    first, second = items.nodes
    assert isinstance(first, Scalar)
    assert isinstance(second, Table)
    assert str(tree.location(first.place)) == "m.yaml:3:5"
    value = second.nodes["k"]
    assert isinstance(value, Scalar)
    assert (value.text, value.plain) == ("v", False)
    assert str(tree.location(value.place)) == "m.yaml:4:9"


def test_columns_count_bytes():
    tree = read_tree("größe: x\n".encode(), "m.yaml")
    assert isinstance(tree.root, Table)
    assert str(tree.location(tree.root.nodes["größe"].place)) == "m.yaml:1:10"


def test_a_byte_order_mark_is_no_part_of_the_text():
    tree = read_tree(b"\xef\xbb\xbfname: x", "m.yaml")
    assert isinstance(tree.root, Table)
    assert list(tree.root.nodes) == ["name"]


@pytest.mark.parametrize("content", [b"", b"\n\n", b"# only a comment\n", b"---\n", b"~", b"null\n"])
def test_nothing_is_read_as_nothing(content: bytes):
    assert read_tree(content, "m.yaml").root is None


def test_aliases_stand_for_what_their_anchor_names():
    tree = read_tree(b"a: &tags [x, y]\nb: *tags\n", "m.yaml")
    assert isinstance(tree.root, Table)
    assert tree.root.nodes["a"] is tree.root.nodes["b"]


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (
            b"a: \xff",
            "m.yaml:1:4: byte 0xff is not UTF-8; expected a text file in UTF-8. Save the file in that encoding",
        ),
        ("é: é\nb: ".encode() + b"\xe9\n", "m.yaml:2:4: byte 0xe9 is not UTF-8"),
        (b"\xff\xfea\x00", "m.yaml:1:1: byte 0xff is not UTF-8"),
        (b"a: x\x01y", "m.yaml:1:5: character '\\x01'; expected text without control characters"),
        (b"a: 1\n\tb: 2", "m.yaml:2:1: a tab in the indentation; expected spaces. Replace the tab by spaces"),
        (b"a:\n  b: 1\n \tc: 2\n", "m.yaml:3:2: a tab in the indentation"),
        (b"a: b: c", "m.yaml:1:5: cannot be read as YAML at 'a: b: c': mapping values are not allowed"),
        (b"a: [1, 2", "cannot be read as YAML"),
        (b"a: 'x", 'cannot be read as YAML at "a: \'x"'),
        (b"a: 1\nb: 2\na: 3\n", "m.yaml:3:1: key 'a' a second time; expected it once (first in line 1)"),
        (b"[a, b]: 1", "m.yaml:1:1: a list or table as a key"),
        (b"a: 1\n---\nb: 2\n", "m.yaml:2:1: a second document; expected one document in a file"),
        (b"a: *x", "m.yaml:1:4: '*x' refers to nothing"),
        (b"a: &x [*x]", "m.yaml:1:8: '*x' refers to nothing"),
        (b"a: !!python/object:os.system x", "m.yaml:1:4: the YAML tag 'tag:yaml.org,2002:python/object:os.system'"),
        (b"[" * 100_000, "m.yaml:1:22: more than 20 levels"),
        (b"- " * 100_000, "m.yaml:1:43: more than 20 levels"),
        (b"#" * (MAX_BYTES + 1), "m.yaml: a file of 1,000,001 bytes; expected at most 1,000,000 bytes"),
    ],
)
def test_what_cannot_be_read_says_where_and_why(content: bytes, message: str):
    with pytest.raises(DocumentError) as caught:
        read_tree(content, "m.yaml")
    assert message in str(caught.value)


@given(st.one_of(st.binary(max_size=200), st.text(alphabet="ab:-[]{}#'\"&*!|>?,\n\t %é\x85\u2028", max_size=60)))
def test_any_bytes_are_read_or_refused_with_a_place(content: bytes | str):
    data = content.encode() if isinstance(content, str) else content
    read = read_or_refuse(data)
    if isinstance(read, DocumentError):
        assert read.where.startswith("m.yaml")
        assert read.expected
    else:
        assert read.root is None or read.location(read.root.place).line >= 1


def read_or_refuse(data: bytes) -> Tree | DocumentError:
    try:
        return read_tree(data, "m.yaml")
    except DocumentError as error:
        return error


def test_the_last_of_two_keys_may_count():
    tree = read_tree(b"a: 1\nb: 2\na: 3\n", "m.yaml", last_counts=True)
    assert isinstance(tree.root, Table)
    assert {key: one.text for key, one in tree.root.nodes.items() if isinstance(one, Scalar)} == {"a": "3", "b": "2"}
    assert tree.root.keys["a"].line == 3


def test_aliases_of_aliases_are_counted():
    lines = ["a: &a [1, 2, 3, 4, 5, 6, 7, 8, 9]"]
    lines += [f"{chr(98 + place)}: &{chr(98 + place)} [{', '.join([f'*{chr(97 + place)}'] * 9)}]" for place in range(9)]
    with pytest.raises(DocumentError, match="more than 200,000 values"):
        read_tree("\n".join(lines).encode(), "a.yaml")
