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


@pytest.fixture
def odd_workspace(workspace):
    """Return one with findings, comments that set some aside, a broken file, and a name that is no UTF-8."""
    (workspace / "p0" / "node.py").write_text(
        "import os, rospy\n\n\ndef ask(x=[]):\n    # roslens: ignore[python.mutable_default] it is never changed\n"
        "    eval(input())  # roslens: ignore[no.such_rule]\n    return x\n"
    )
    branches = "".join(f"  if (x == {number}) return {number};\n" for number in range(40))
    (workspace / "p1" / "long.cpp").write_text(f"int g(int x) {{\n{branches}  return 0;\n}}\nint broken( {{ = ; }}\n")
    (workspace / "p2" / os.fsdecode(b"caf\xe9.cpp")).write_text(f"int h(int x) {{\n{branches}  return 0;\n}}\n")
    (workspace / "p3" / "CMakeLists.txt").write_text("find_package(nothing REQUIRED)\n")
    (workspace / "p4" / "other.cpp").write_text(f"int k(int x) {{\n{branches}  return 0;\n}}\n")
    (workspace / "roslens.toml").write_text(
        '[[ignore]]\npaths = ["p4/**"]\nrules = ["ros.*"]\nreason = "made by a generator"\n'
    )
    return workspace


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


def test_what_is_odd_is_the_same_in_processes(odd_workspace):
    code, here = report(odd_workspace, "--engine", "in-process")
    assert (code, here) == report(odd_workspace, "--engine", "processes", "--jobs", "2")
    assert len(here["findings"]) > 5
    assert here["failures"]
    assert "caf" in json.dumps([here["failures"], here["files"]])
    assert here["set_aside"]


@pytest.mark.nightly
def test_a_cluster_and_none(workspace, tmp_path):
    from test_dask_engine import cluster

    here = report(workspace, "--engine", "in-process")
    with cluster(tmp_path, 2) as (address, _):
        assert report(workspace, "--engine", address) == here
