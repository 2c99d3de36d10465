from __future__ import annotations

import json

import pytest

from roslens.cli.main import main
from roslens.source.metrics.size import comment_ratio


@pytest.mark.parametrize("values", [{"loc": 0.0, "comment_lines": 5.0}, {"comment_lines": 5.0}])
def test_without_code_there_is_no_ratio(values):
    assert comment_ratio.of_values(values) is None


def test_it_is_in_per_cent_and_may_exceed_a_hundred():
    assert comment_ratio.of_values({"loc": 4.0, "comment_lines": 1.0}) == 25
    assert comment_ratio.of_values({"loc": 4.0, "comment_lines": 5.0}) == 125


@pytest.mark.parametrize(
    ("path", "table"),
    [("a/setup.py", True), ("setup.py", True), ("a/cfg/Node.cfg", True), ("a/my_setup.py", False), ("a/cfg.py", False)],
)
def test_tables_speak_for_themselves(path, table):
    assert comment_ratio.speaks_for_itself(path) is table


def test_tables_without_comments_are_notes(tmp_path, capsys):
    (tmp_path / "package.xml").write_text("<package><name>p</name><version>1.0.0</version></package>")
    (tmp_path / "cfg").mkdir()
    for name in ("setup.py", "cfg/Node.cfg", "drive.py"):
        (tmp_path / name).write_text("#!/usr/bin/env python3\n" + "a = 1\nb = 2\nc = 3\n" * 9)
    options = ["--format", "json", "--model", "ros", "--jobs", "1", "-q", "--no-graph", "--fail-on", "never"]
    main(["check", str(tmp_path), *options])
    found = json.loads(capsys.readouterr().out)["findings"]
    reported = {one["path"]: one["severity"] for one in found if one["rule"] == "ros.comment_ratio.min"}
    assert reported == {"setup.py": "note", "cfg/Node.cfg": "note", "drive.py": "warning"}
