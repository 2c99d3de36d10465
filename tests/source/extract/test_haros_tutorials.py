"""The tutorials of HAROS against a table labelled by reading their source and launch files.

``ROSLENS_CORPORA`` may name a folder with a checkout of haros_tutorials. Each row is an endpoint of a node that a
launch file starts; a row without one is a node of which nothing can be known.
"""

import csv
import os
from pathlib import Path

import pytest
from known_mistakes.checkout import check_out
from known_mistakes.pairs import read_graph

TABLE = Path(__file__).parents[2] / "fixtures" / "extract" / "haros_tutorials" / "endpoints.csv"
COMMIT = "6576ae667894f5cca2c4c242c16bbc84b8ac865f"


def rows():
    with TABLE.open() as file:
        return list(csv.DictReader(file))


@pytest.fixture(scope="module")
def tutorials(tmp_path_factory):
    clone = Path(os.environ.get("ROSLENS_CORPORA", "")) / "haros_tutorials"
    if not os.environ.get("ROSLENS_CORPORA") or not clone.is_dir():
        pytest.skip("ROSLENS_CORPORA names no folder with haros_tutorials")
    folder = tmp_path_factory.mktemp("tutorials")
    check_out(clone, COMMIT, folder)
    return folder


@pytest.mark.corpora
@pytest.mark.heavy
@pytest.mark.parametrize("launch", sorted({row["launch"] for row in rows()}))
def test_every_node_topic_and_type(tutorials, launch):
    labelled = [row for row in rows() if row["launch"] == launch]
    graph = read_graph(tutorials, tutorials / "src" / launch)
    assert [node["name"] for node in graph["nodes"]] == sorted({row["node"] for row in labelled})
    ends = [
        (node["name"], one["endpoint"]["role"], one["endpoint"]["name"], one["endpoint"]["type"])
        for node in graph["nodes"]
        for one in node.get("endpoints", ())
        if one["proof"].get("origin") != "implicit"
    ]
    assert sorted(ends) == sorted(
        (row["node"], row["role"], row["name"], row["type"]) for row in labelled if row["role"]
    )
