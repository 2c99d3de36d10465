"""What is no graph is said with its place; that a graph comes back as it was written is in test_to_rosgraph.py."""

from __future__ import annotations

import pytest

from roslens.live.observe.read_rosgraph import read_rosgraph
from roslens.model.errors import DocumentError
from roslens.model.graph import Endpoint, Graph, Node, Role


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "the file is empty"),
        ("[1, 2]", "the file holds a list"),
        ("nodes: 3", "nodes is '3'; expected a list"),
        ("nodes:\n- name: /a\n  publishers:\n  - topic: /x", "4:5: unknown key 'topic' of a topic or service"),
    ],
)
def test_what_is_wrong_is_said(text, said, tmp_path):
    path = tmp_path / "graph.yaml"
    path.write_text(text)
    with pytest.raises(DocumentError) as error:
        read_rosgraph(path)
    assert said in str(error.value)


def test_what_a_person_writes_is_enough(tmp_path):
    path = tmp_path / "graph.yaml"
    path.write_text(
        "nodes:\n- name: /a\n  publishers:\n  - {name: /x, type: {name: t/T}}\n  service_servers: [{name: /s}]\n"
    )
    assert read_rosgraph(path) == Graph(
        "", (Node("/a"),), (Endpoint("/a", Role.PUBLISHER, "/x", "t/T"), Endpoint("/a", Role.SERVICE_SERVER, "/s"))
    )
