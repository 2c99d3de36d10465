"""Whatever measures, the report is the same."""

import json
import os
import sys

import pytest

from roslens.cli.main import main

sys.path.insert(0, os.path.dirname(__file__))  # noqa: PTH120 - the cluster of the test beside
MANIFEST = (
    '<package format="3"><name>p{0}</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">a</maintainer><license>MIT</license></package>\n'
)


@pytest.fixture
def workspace(tmp_path):
    for number in range(6):
        folder = tmp_path / "ws" / f"p{number}"
        folder.mkdir(parents=True)
        (folder / "package.xml").write_text(MANIFEST.format(number))
        (folder / "a.cpp").write_text(f"int f{number}(int x) {{ if (x > {number}) {{ return 1; }} return 0; }}\n")
    return tmp_path / "ws"


def report(workspace, *words):
    out = workspace.parent / "r.json"
    code = main(
        [
            "check",
            str(workspace),
            "-q",
            "--no-store",
            "--no-cache",
            "--no-graph",
            "--format",
            "json",
            "-o",
            str(out),
            *words,
        ]
    )
    found = json.loads(out.read_text())
    del found["run"]
    return code, found


def test_processes_and_none(workspace):
    assert report(workspace, "--engine", "in-process") == report(workspace, "--engine", "processes", "--jobs", "2")
    assert main(["check", str(workspace), "-q", "--engine", "spark"]) == 2


@pytest.mark.nightly
def test_a_cluster_and_none(workspace, tmp_path):
    from test_dask_engine import cluster

    here = report(workspace, "--engine", "in-process")
    with cluster(tmp_path, 2) as (address, _):
        assert report(workspace, "--engine", address) == here
