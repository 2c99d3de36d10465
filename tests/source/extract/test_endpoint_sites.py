"""Call sites that make endpoints in real code, against tables labelled by reading their source.

``ROSLENS_CORPORA`` may name a folder with checkouts; a repository that is not there is left out.
"""

import os
from pathlib import Path

import pytest
from endpoint_sites.measuring import (
    REPOSITORIES,
    Seen,
    found_by_command,
    holes,
    is_named,
    is_typed,
    measured,
    relative,
    rows_of,
)
from endpoint_sites.of_command import Told, asked, checkouts, judged, told_of
from endpoint_sites.page import page
from endpoint_sites.text_calls import TextCall, text_calls

from roslens.model.graph import Role

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
    found = measured(rows_of(repository), found_by_command(asked(root)))
    assert found.share("found") >= 0.98, found.missed
    assert found.share("typed") >= 0.95, found.missed
    assert found.share("named") >= 0.85, found.missed
    # What is called certain has to be as the table says, however much else is missed.
    assert not found.wrong


def row(line, name, *, decides="", type_="p/msg/T", path="a.cpp", role="publisher"):
    return {"path": path, "line": str(line), "role": role, "type": type_, "name": name, "decides": decides}


def made(line, given, type_="p/msg/T"):
    return (line, Seen(given, type_))


def test_what_is_missed_and_what_is_wrong():
    known = {("a.cpp", "publisher"): [made(3, "x"), made(8, "y", "p/msg/Other")]}
    rows = [row(2, "x"), row(8, "z"), row(20, "w"), row(2, "x|v", role="subscription")]
    found = measured(rows, known)
    assert (found.counts["all", "sites"], found.counts["publisher", "sites"]) == (4, 3)
    assert (found.share("found"), found.share("typed"), found.share("named")) == (0.5, 0.25, 0.25)
    assert len(found.missed) == 3
    assert found.wrong == ["a.cpp:8 is not y p/msg/Other for sure"]


def test_names_tell_what_decides_them():
    parameter = "{parameter topic}_out"
    assert is_named(row(1, "*_out", decides="topic"), parameter)
    assert is_named(row(1, "*", decides="other|caller"), parameter)
    assert not is_named(row(1, "*", decides="other"), parameter)
    assert not is_named(row(1, "*", decides="_out"), parameter)
    assert not is_named(row(1, "scan"), parameter)
    assert not is_named(row(1, "*", decides="caller"), "{result of read()}")
    assert is_named(row(1, "*", decides="*.topic"), "{parameter {each of parameter sources}.topic}")
    assert holes("a/{parameter {each of b}.topic}/c") == ("parameter each of b.topic", "parameter *.topic")
    assert is_typed(row(1, "x", type_="*"), "p/msg/A")
    assert not is_typed(row(1, "x", type_="*"), "")
    assert relative("{namespace of the node}/scan") == "scan"
    assert is_named(row(1, "scan"), "{namespace of the node}/scan")


CPP = """#include <ros/ros.h>
// nh.advertise<A>("commented", 1);
  virtual void subscribe() = 0;
  ros::Subscriber subscribe(
bool Data::subscribe(const std::string & name)
  explicit Publisher(const T & of) {}
  pub = nh.advertise<std_msgs::String>("a", 1);
  return other->subscribe(
    "b", 1);
}
"""
PYTHON = """import rospy
from rospy import Publisher
'''
rospy.Publisher('text', String)
'''
def go(self):
    self.pub = rospy.Publisher('a', String)  # rospy.Subscriber(
"""


def test_calls_are_counted_by_text(tmp_path):
    script = f"#!/usr/bin/python3\n{PYTHON}"
    for path, text in (("a/x.cpp", CPP), ("a/y.py", PYTHON), ("a/test/z.py", PYTHON), ("run", script)):
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
    found = [(one.path, one.line) for one in text_calls(tmp_path)]
    assert found == [("a/x.cpp", 7), ("a/x.cpp", 8), ("a/y.py", 7), ("run", 8)]


def test_a_call_is_shown_or_named_or_lost():
    end = {"proof": {"path": "a.cpp", "line": 3}, "through": [{"path": "b.cpp", "line": 20}]}
    answer = {
        "configurations": [
            {"nodes": [{"endpoints": [end]}], "unresolved": [{"proof": {"path": "a.cpp", "line": 40}}]},
            {"nodes": [], "unstarted": True},
        ]
    }
    calls = [TextCall(path, line, "") for path, line in (("a.cpp", 6), ("a.cpp", 7), ("a.cpp", 39), ("b.cpp", 19))]
    found = judged(calls, answer, "1a2b3c4")
    assert (found.calls, found.shown, found.named) == (4, 2, 1)
    assert found.lost == (calls[1],)


def test_the_command_is_what_is_measured(tmp_path):
    (tmp_path / "owner+name").mkdir()
    (tmp_path / "owner+name" / "a.py").write_text("import rospy\nrospy.init_node('a')\nrospy.Publisher('b', int)\n")
    ((name, root),) = checkouts(tmp_path)
    found = told_of(root)
    assert (name, found.calls, found.shown) == ("owner/name", 1, 1)
    assert [path.name for path in root.iterdir()] == ["a.py"]


def test_the_page_tells_shares_and_what_is_missed():
    known = {("a.cpp", "publisher"): [made(3, "x")]}
    found = measured([row(3, "x"), row(9, "y", decides="message")], known)
    told = {"o/b": Told("7654321", 0, 0, 0, ()), "o/a": Told("1234567", 8, 6, 1, (TextCall("a.cpp", 1, ""),))}
    text = page(told, {"navigation2": ("1a2b3c4", found)})
    assert "| o/a | `1234567` | 8 | 6 | 1 | 1 | 75.0 % | 87.5 % |\n| o/b | `7654321` | 0 | 0 | 0 | 0 |  |  |" in text
    assert "| all 2 | | 8 | 6 | 1 | 1 | 75.0 % | 87.5 % |" in text
    assert "| navigation2 | `1a2b3c4` | 2 | 50.0 % | 50.0 % | 50.0 % | 1 | 0 |" in text
    assert "| publishers | 2 | 26 | 1 | 1 | 1 |" in text
    assert "`a.cpp:9`" in text
    assert "Endpoints with" not in page(told, {})
    assert "developed on these" not in page(told, {})
    assert "developed on these" in page(told, {}, tuned=True)
