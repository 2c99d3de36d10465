"""The way from what runs to its source: pages of entities, marks in files, nodes of packages, and search."""

from __future__ import annotations

from collections.abc import Iterator
from types import ModuleType

import msgspec
import pytest
from dashboard.conftest import Client

from roslens.dashboard.last_change import LastChange, unknown_change
from roslens.dashboard.live.snapshot import Named, names_in
from roslens.dashboard.pages.entity import page_of
from roslens.dashboard.pages.search import everything
from roslens.dashboard.server import create_app
from roslens.dashboard.site import Site
from roslens.model.configuration import ConfiguredNode, Proof


@pytest.fixture
def rooted(site: Site, made_up: ModuleType) -> Iterator[tuple[Site, ConfiguredNode]]:
    """The site with one node in a package and a file that it has."""
    path, place = next(iter(site.places.items()))
    robot = made_up.robot()
    node = msgspec.structs.replace(
        robot.nodes[0], package=place.package, defined=Proof(path, 2, sure="certain"), endpoints=()
    )
    kept = site.book
    site.show_graphs({"one": msgspec.structs.replace(robot, nodes=(node,))}, {}, "", counted=True)
    yield site, node
    site.__dict__["book"] = kept


@pytest.fixture
def first(site: Site) -> dict[str, str]:
    """One entity of each kind that a graph of the site has."""
    found: dict[str, str] = {}
    for system in site.book.systems.values():
        for element in system.elements:
            if "implicit" not in element.noise:
                found.setdefault(element.kind.value, element.name)
    return found


def test_names_lead_to_the_page_of_the_first_graph_that_has_them(site: Site, first: dict[str, str]) -> None:
    assert {"node", "topic"} <= set(first)
    for kind, name in first.items():
        ref = page_of(site, f"{kind}:{name}")
        assert ref is not None
        assert ref.page == ("node" if kind == "node" else "topic")
        held = site.book.find(ref.page, ref.key)
        assert held is not None
        assert held[0].elements[held[1]].name == name


def test_connections_lead_to_their_topic_and_parameters_to_their_node(site: Site, first: dict[str, str]) -> None:
    topic, node = first["topic"], first["node"]
    assert page_of(site, f"connection:/a > {topic} > ?") == page_of(site, f"topic:{topic}")
    assert page_of(site, f"parameter:{node}:rate") == page_of(site, f"node:{node}")


@pytest.mark.parametrize(
    "entity", ["", "node", "node:", "topic:/no/such", "host:vm", "<script>:x", "file:../../etc/passwd"]
)
def test_what_is_unknown_has_no_page(site: Site, entity: str) -> None:
    assert page_of(site, entity) is None


def test_what_is_unknown_is_searched_for_and_found_where_it_runs(site: Site, first: dict[str, str]) -> None:
    client = Client(create_app(site))
    assert client.get("/entity?id=node:/gone").headers["location"] == "/search?q=%2Fgone"
    found = client.get(f"/entity?id=topic:{first['topic']}")
    assert found.status_code == 303
    assert found.headers["location"].startswith("/topics/")
    # An address of somebody else is none of ours.
    assert client.get("/entity?id=node://evil.example").headers["location"].startswith("/search?")


def test_a_file_says_what_its_lines_are_to_the_graphs(rooted: tuple[Site, ConfiguredNode]) -> None:
    site, node = rooted
    assert node.defined is not None
    (mark,) = site.code_marks.of(node.defined.path)[2]
    assert (mark.name, mark.does) == (node.name, "defines node")
    page = Client(create_app(site)).get(f"/files/{node.defined.path}").text
    assert "defines node <a href=" in page


def test_a_package_lists_its_nodes(rooted: tuple[Site, ConfiguredNode]) -> None:
    site, node = rooted
    rows = Client(create_app(site)).get(f"/packages/{node.package}.json").json()["tables"]["nodes"]["rows"]
    assert [row["node"] for row in rows] == [node.name]


def test_who_changed_it_last_stands_beside_its_findings(rooted: tuple[Site, ConfiguredNode]) -> None:
    site, node = rooted
    ref = page_of(site, f"node:{node.name}")
    assert ref is not None
    client = Client(create_app(site))
    site.last_change = lambda path: LastChange("Ada <b>", "2026-05-01", "abc1234", f"mend {path}")
    try:
        (row,) = client.get(f"/nodes/{ref.key}.json").json()["tables"]["code"]["rows"]
        assert row["changed_by"] == "Ada <b>"
        assert row["package"] == node.package
        assert "Ada &lt;b&gt;" in client.get(f"/nodes/{ref.key}").text
    finally:
        site.last_change = unknown_change


def test_what_runs_is_searched_too_each_name_once(site: Site, first: dict[str, str]) -> None:
    text = (
        b'{"rows": [{"entity": "host:vm", "name": "vm", "kind": "host"}, {"entity": "host:vm", "name": "vm", "kind":'
        b' "host"}, {"entity": "node:%s", "name": "%s", "kind": "node"}]}'
        % (first["node"].encode(), first["node"].encode())
    )
    running = names_in(text)
    assert running[0] == Named("host:vm", "vm", "host")
    assert names_in(b"") == ()
    site.running = lambda: running
    try:
        found = [(kind, name) for kind, name, *_ in everything(site)]
        assert found.count(("host", "vm")) == 1
        assert found.count(("node", first["node"])) == 1
    finally:
        site.running = tuple
