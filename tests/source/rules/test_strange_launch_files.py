"""Launch files and files of parameters that are no text, nested or very large: each is told, and the rest goes on."""

import sys

import pytest

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.table import native_rules

MANIFEST = (
    "<package format='3'><name>base</name><version>1.0.0</version><description>d</description>"
    "<maintainer email='a@example.org'>a</maintainer><license>MIT</license>"
    "<export><build_type>ament_cmake</build_type></export></package>"
)
XML = '<launch><!-- gr\xfcn --><node pkg="base" exec="drive" name="drive"/></launch>\n'
YAML = "launch:\n# gr\xfcn\n- node: {pkg: base, exec: drive, name: drive}\n"
PYTHON = "# gr\xfcn\ndef generate_launch_description():\n    return LaunchDescription([])\n"
PARAMETERS = "drive:  # gr\xfcn\n  ros__parameters:\n    gain: 1\n"
LEVELS = 2_000
NODES = 100_000
TEXTS = {
    "launch/a.launch.xml": XML,
    "launch/a.launch.yaml": YAML,
    "launch/a.launch.py": PYTHON,
    "config/a.yaml": PARAMETERS,
}
WAYS = {
    "UTF-16": lambda text: text.encode("utf-16-le"),
    "NUL": lambda text: text.replace("gr\xfcn", "gr\0n").encode(),
    "latin-1": lambda text: text.encode("latin-1"),
}
TAKEN = {("config/a.yaml", "UTF-16")} | ({("launch/a.launch.py", "latin-1")} if sys.version_info < (3, 14) else set())
"""What does not show that it has parameters, and what Python does not mind in a comment before 3.14."""


@pytest.fixture
def told(tmp_path, package_view):
    """What the rules on files that are refused say of a package with some files: path, line, certainty."""

    def of(files):
        (tmp_path / "package.xml").write_text(MANIFEST)
        (tmp_path / "launch").mkdir(exist_ok=True)
        (tmp_path / "config").mkdir(exist_ok=True)
        (tmp_path / "launch/good.launch.xml").write_text("<launch><node></launch>")
        for path, content in files.items():
            (tmp_path / path).write_bytes(content)
        view = package_view(tmp_path)
        rules = [
            rule for rule in native_rules().values() if rule.id in ("launch.unreadable", "launch.refused_parameters")
        ]
        hits = [hit for rule in rules for hit in rule.found(view)]
        found = {hit.path: hit for hit in hits}
        # The mistake in the file beside them is told whatever these are.
        assert found.pop("launch/good.launch.xml").line == 1
        return found

    return of


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("path", TEXTS)
def test_what_is_no_text_in_utf_8_is_told_by_its_file(told, path, way):
    found = told({path: WAYS[way](TEXTS[path])})
    assert found.keys() == (set() if (path, way) in TAKEN else {path})
    assert all(hit.line >= 1 for hit in found.values())


@pytest.mark.parametrize(
    ("path", "content", "says"),
    [
        ("launch/a.launch.xml", f"<launch>{'<group>' * LEVELS}{'</group>' * LEVELS}</launch>", "levels"),
        ("launch/a.launch.yaml", f"launch: {'[' * LEVELS}{']' * LEVELS}", "levels"),
        ("launch/a.launch.py", f"def generate_launch_description():\n    f({'[' * LEVELS}{']' * LEVELS})", "nested"),
        ("config/a.yaml", f"drive:\n  ros__parameters:\n    a: {'{a: ' * LEVELS}1{'}' * LEVELS}", "nested too deeply"),
    ],
)  # fmt: skip
def test_two_thousand_levels_are_told_by_their_file(told, path, content, says):
    found = told({path: content.encode()})
    assert says in found[path].message


def test_a_hundred_thousand_nodes_are_read_or_it_is_told_that_they_are_not(told):
    node = '<node pkg="base" exec="drive"/>\n'
    assert not told({"launch/a.launch.xml": f"<launch>{node * NODES}</launch>".encode()})
    found = told({"launch/a.launch.xml": f"<launch>{node * (NODES + NODES // 2)}</launch>".encode()})
    assert found["launch/a.launch.xml"].certainty is Certainty.HEURISTIC
    assert "what this file starts is not judged" in found["launch/a.launch.xml"].message


def test_a_large_file_of_parameters_is_told(told):
    lines = "".join(f"    parameter_{number}: {number}\n" for number in range(NODES))
    found = told({"config/a.yaml": f"drive:\n  ros__parameters:\n{lines}".encode()})
    assert "bytes: whether rcl takes the file is not judged" in found["config/a.yaml"].message
