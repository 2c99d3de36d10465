"""The page and the schema of references hold what the reader knows, and the schema takes what the reader takes."""

from __future__ import annotations

from pathlib import Path

import jsonschema
import pytest

from roslens.judge.documents.yaml_tree import Items, Node, Scalar, Table, read_tree
from roslens.judge.pages.references_page import EXAMPLE, reference_schema, references_page
from roslens.judge.reading.read_reference import GivenText, load_reference, read_references
from roslens.judge.reference.reference_keys import CHAIN_KEYS, FIELD_KEYS, REFERENCE_KEYS, WHEN_KEYS, constraint_keys
from roslens.live.window.signals import BY_KEY
from roslens.model.errors import DocumentError

FIXTURES = Path(__file__).parents[1] / "fixtures" / "references"
SCHEMA = jsonschema.Draft202012Validator(reference_schema(BY_KEY))
DRIVE = b"kind: reference\nname: drive\nconstraints: [{id: wheels, topic: /odom, rate: 50..60 Hz}]"


def value(node: Node | None) -> object:
    """What an editor makes of a document: YAML 1.2, in which only true and false are no texts."""
    if isinstance(node, Table):
        return {key: value(one) for key, one in node.nodes.items()}
    if isinstance(node, Items):
        return [value(one) for one in node.nodes]
    assert isinstance(node, Scalar)
    if not node.plain:
        return node.text
    try:
        return {"true": True, "false": False}.get(node.text) if node.text in {"true", "false"} else float(node.text)
    except ValueError:
        return node.text


def accepted(text: str) -> bool:
    return not list(SCHEMA.iter_errors(value(read_tree(text.encode(), "r.yaml").root)))


def test_the_schema_is_one():
    jsonschema.Draft202012Validator.check_schema(reference_schema(BY_KEY))


def test_the_page_names_every_key():
    page = references_page(BY_KEY)
    for keys in (REFERENCE_KEYS, constraint_keys(BY_KEY), FIELD_KEYS, WHEN_KEYS, CHAIN_KEYS):
        assert [key for key in keys if f"| `{key}` |" not in page] == []


def test_the_example_of_the_page_is_a_reference(tmp_path: Path):
    (tmp_path / "drive.yaml").write_bytes(DRIVE)
    reference = load_reference([GivenText("example.yaml", EXAMPLE.encode(), str(tmp_path))], BY_KEY)
    assert len(reference.expectations) == 10
    assert len(reference.states) == 3
    assert accepted(EXAMPLE)


@pytest.mark.parametrize("path", sorted(FIXTURES.rglob("*.yaml")), ids=lambda path: path.name)
def test_the_schema_takes_what_the_reader_takes(path: Path):
    assert read_references([path], BY_KEY)
    assert accepted(path.read_text("utf-8"))


HEAD = "kind: reference\nname: r\n"


@pytest.mark.parametrize(
    "text",
    [
        HEAD,
        HEAD + "constraints: [{topic: /a, rate: 5}]".replace("rate: 5", "publishers: 1"),
        HEAD + "constraints: [{topic: 12, rate: 1..2, for: 3, grace: 1 s, on: no}]".replace(", on: no", ""),
        HEAD + "constraints: [{node: no, on: true, cpu: <= 5 %, text: 5}]",
        HEAD + "constraints: [{topic: /a, without: /b, expected: while  node /c}]",
        HEAD + "constraints: [{topic: /a, id: x, override: false, expected: at most one}]",
        HEAD + "include: []\nfields: []\nchains: []",
    ],
)
def test_both_take_these(text: str):
    assert read_references([GivenText("r.yaml", text.encode())], BY_KEY)
    assert accepted(text)


@pytest.mark.parametrize(
    "text",
    [
        "kind: model\nname: r",
        "kind: reference",
        HEAD + "constraints: [{topic: /a}]",
        HEAD + "constraints: [{rate: 1..2}]",
        HEAD + "constraints: [{topic: /a, node: /b, rate: 1..2}]",
        HEAD + "constraints: [{topic: /a, raet: 1..2}]",
        HEAD + "constraints: [{topic: /a, expected: sometimes}]",
        HEAD + "constraints: [{topic: /a, rate: 1..2, override: true}]",
        HEAD + "constraints: [{topic: /a, rate: 1..2, severity: bad}]",
        HEAD + "fields: [{topic: /a, field: x}]",
        HEAD + "chains: [{topics: [/a], age: <= 1 s}]",
    ],
)
def test_both_refuse_these(text: str):
    with pytest.raises(DocumentError):
        read_references([GivenText("r.yaml", text.encode())], BY_KEY)
    assert not accepted(text)
