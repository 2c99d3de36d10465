"""A kept result is not taken where a file changed that has no language and that rules read."""

import json

import pytest

from roslens.cli.main import main

MANIFEST = "<package><name>p</name><export><build_type>catkin</build_type></export></package>"
INCLUDES = '<launch><include file="$(find p)/launch/one.launch"/></launch>'
LAUNCH = '<launch><param name="ns" value="$(arg name)"/></launch>'


@pytest.mark.parametrize("path", ["README.md", "p/start.sh"])
def test_a_command_line_that_is_written_later_counts(path, tmp_path, capsys):
    (tmp_path / "p/launch").mkdir(parents=True)
    given = (
        ("p/package.xml", MANIFEST),
        ("p/launch/one.launch", LAUNCH),
        ("p/launch/all.launch", INCLUDES),
        (path, "Nothing yet.\n"),
    )
    for name, text in given:
        (tmp_path / name).write_text(text)

    def severities():
        main(["check", str(tmp_path), "--format", "json", "--jobs", "1", "-q", "--no-graph", "--fail-on", "never"])
        found = json.loads(capsys.readouterr().out)["findings"]
        return [one["severity"] for one in found if one["rule"] == "launch.undeclared_argument"]

    assert severities() == ["warning"]
    (tmp_path / path).write_text("roslaunch p one.launch name:=b\n")
    assert severities() == ["note"]
