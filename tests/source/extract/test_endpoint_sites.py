"""Call sites that make endpoints in real code, against tables labelled by reading their source.

``ROSLENS_CORPORA`` may name a folder with checkouts; a repository that is not there is left out.
"""

import os
from pathlib import Path

import pytest
from endpoint_sites.measuring import (
    REPOSITORIES,
    found_below,
    is_named,
    is_typed,
    measured,
    programs_below,
    relative,
    rows_of,
)
from endpoint_sites.page import page

from roslens.model.graph import Role
from roslens.source.extract.node_facts import EndpointFact, Evidence
from roslens.source.extract.text import Hole, Text

SITES = {
    "navigation2": 202, "turtlebot3": 34, "demos": 103, "examples": 95, "image_pipeline": 79, "navigation": 66,
    "ros_tutorials": 66,
}  # fmt: skip


@pytest.mark.parametrize("repository", REPOSITORIES)
def test_tables_are_whole(repository):
    rows = rows_of(repository)
    assert len(rows) == SITES[repository]
    assert len({(row["path"], row["line"], row["role"]) for row in rows}) == len(rows)
    for row in rows:
        assert row["role"] in {role.value for role in Role}
        assert row["line"].isdecimal()
        assert row["type"]
        assert row["name"]
        assert ("*" in row["name"]) <= bool(row["decides"])


@pytest.mark.corpora
@pytest.mark.heavy
@pytest.mark.parametrize("repository", REPOSITORIES)
def test_call_sites_of(repository):
    root = Path(os.environ.get("ROSLENS_CORPORA") or "/nowhere") / repository
    if not root.is_dir():
        pytest.skip(f"ROSLENS_CORPORA names no folder with {repository}")
    found = measured(rows_of(repository), found_below(root))
    assert found.share("found") >= 0.98, found.missed
    assert found.share("typed") >= 0.95, found.missed
    assert found.share("named") >= 0.85, found.missed
    # What is called certain has to be as the table says, however much else is missed.
    assert not found.wrong


def row(line, name, *, decides="", type_="p/msg/T", path="a.cpp", role="publisher"):
    return {"path": path, "line": str(line), "role": role, "type": type_, "name": name, "decides": decides}


def made(line, name, type_="p/msg/T"):
    fact = EndpointFact(Role.PUBLISHER, name, Text.of(type_), Evidence("a.cpp", line))
    return (line, fact)


def test_what_is_missed_and_what_is_wrong():
    known = {("a.cpp", "publisher"): [made(3, Text.of("x")), made(8, Text.of("y"), "p/msg/Other")]}
    rows = [row(2, "x"), row(8, "z"), row(20, "w"), row(2, "x|v", role="subscription")]
    found = measured(rows, known)
    assert (found.counts["all", "sites"], found.counts["publisher", "sites"]) == (4, 3)
    assert (found.share("found"), found.share("typed"), found.share("named")) == (0.5, 0.25, 0.25)
    assert len(found.missed) == 3
    assert found.wrong == ["a.cpp:8 is not y p/msg/Other for sure"]


def test_names_tell_what_decides_them():
    parameter = Text((Hole("parameter topic", "topic", "scan"), "_out"))
    assert is_named(row(1, "*_out", decides="topic"), parameter)
    assert is_named(row(1, "*", decides="other|caller"), parameter)
    assert not is_named(row(1, "*", decides="other"), parameter)
    assert not is_named(row(1, "scan"), parameter)
    assert not is_named(row(1, "*", decides="caller"), Text((Hole("result of read()"),)))
    assert is_typed(row(1, "x", type_="*"), Text.of("p/msg/A"))
    assert not is_typed(row(1, "x", type_="*"), Text((Hole("a type"),)))
    own = Text((Hole("namespace of the node", default=""), "/scan"))
    assert relative(own) == Text.of("scan")
    assert is_named(row(1, "scan"), own)


def test_programs_are_those_outside_of_tests(tmp_path):
    for path, text in (("a/x.cpp", "int x;"), ("a/test/y.cpp", "int y;"), ("b/run", "#!/usr/bin/env python3\n")):
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
    assert [name for name, _ in programs_below(tmp_path)] == ["a/x.cpp", "b/run"]


def test_the_page_tells_shares_and_what_is_missed():
    known = {("a.cpp", "publisher"): [made(3, Text.of("x"))]}
    found = measured([row(3, "x"), row(9, "y", decides="message")], known)
    text = page({"navigation2": ("1a2b3c4", found)})
    assert "| navigation2 | `1a2b3c4` | 2 | 50.0 % | 50.0 % | 50.0 % | 1 | 0 |" in text
    assert "| publishers | 2 | 26 | 1 | 1 | 1 |" in text
    assert "`a.cpp:9`" in text
