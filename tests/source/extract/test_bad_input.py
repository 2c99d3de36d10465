"""Files that want to hang whoever reads them, or to fill its memory: each ends with its reason, in bounded time."""

import json
import os
import resource
import subprocess
import sys

import pytest

PACKAGE = "<package format='2'><name>bad</name><version>1.0.0</version><description>d</description>\
<maintainer email='a@b.c'>a</maintainer><license>BSD</license></package>"
MOST_CPU_S = 60
MOST_BYTES = 4_000_000_000
PYTHON = """
import os
from launch import LaunchDescription
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node

def f(a):
    return f([a, a])

def generate_launch_description():
    a, b, c, s = LaunchConfiguration('x'), [], {}, 'x'
    for i in range(100):
        %s
    return LaunchDescription([Node(package='bad', executable='one', name=%s)])
"""
GROWING = {
    "substitution": ("a = PathJoinSubstitution([a, a])", "a"),
    "list": ("b = [b, b]", "b"),
    "table": ("c = {'k': c, 'l': c}", "str(c)"),
    "format": ("s = f'{s}{s}'", "s"),
    "sum": ("s += s", "s"),
    "join": ("s = ''.join([s, s])", "s"),
    "itself": ("b.append(b)", "b"),
    "extended": ("b += b or ['x']; b.extend(b)", "b"),
    "item": ("c['c'] = c", "str(c)"),
    "call": ("b = f(b)", "b"),
    "forever": ("while True: pass", "s"),
    "commands": ("os.system('exit')", "s"),
}
BOMB = "a: &a {k: 1, l: 2, m: 3, n: 4, o: 5, p: 6, q: 7, r: 8, s: 9}\n" + "".join(
    f"{chr(98 + place)}: &{chr(98 + place)} {{{', '.join(f'k{key}: *{chr(97 + place)}' for key in range(9))}}}\n"
    for place in range(9)
)
LISTS = "a: &a [1, 2, 3, 4, 5, 6, 7, 8, 9]\n" + "".join(
    f"{chr(98 + place)}: &{chr(98 + place)} [{', '.join([f'*{chr(97 + place)}'] * 9)}]\n" for place in range(9)
)
LAUGHS = (
    '<!DOCTYPE l [<!ENTITY a "aaaaaaaaaa">'
    + "".join(f'<!ENTITY {chr(98 + place)} "{f"&{chr(97 + place)};" * 10}">' for place in range(9))
    + ']><launch><param name="x" value="&j;"/></launch>'
)
NODE = '<node pkg="bad" type="one" name="n"/>'
XML = {
    "laughs": (LAUGHS, "entity"),
    "outside": ('<!DOCTYPE l [<!ENTITY a SYSTEM "file:///etc/hostname">]><launch>&a;</launch>', "entity"),
    "deep": (f"<launch>{'<group>' * 10_000}{NODE}{'</group>' * 10_000}</launch>", "nested deeper"),
    "parentheses": (f'<launch><param name="x" value="$(eval {"(" * 10_000}1{")" * 10_000})"/>{NODE}</launch>', ""),
    "never_closed": (f'<launch><param name="x" value="{"$(" * 10_000}"/>{NODE}</launch>', "never closed"),
    "powers": (f'<launch><param name="x" value="$(eval 9**9**9)"/>{NODE}</launch>', ""),
    "doubled": (
        '<launch><arg name="a0" default="xxxxxxxxxx"/>'
        + "".join(f'<arg name="a{one}" default="{f"$(arg a{one - 1})" * 10}"/>' for one in range(1, 12))
        + '<include file="$(arg a11)"/></launch>',
        "too long",
    ),
    "bomb": ('<launch><rosparam file="$(find bad)/bomb.yaml"/></launch>', "values"),
    "list_bomb": ('<launch><rosparam file="$(find bad)/list.yaml"/></launch>', "values"),
    "of_python": ("<launch><rosparam>a: !!python/object/apply:os.system [exit]</rosparam></launch>", "tag"),
    "itself": ('<launch><include file="$(find bad)/launch/itself.launch"/></launch>', "includes itself"),
    "pipe": ('<launch><include file="$(find bad)/launch/pipe"/></launch>', "no such file"),
    "device": ('<launch><include file="$(find bad)/launch/zero"/></launch>', "no such file"),
    "loop": ('<launch><include file="$(find bad)/launch/loop"/></launch>', "no such file"),
    "remaps": (f'<launch><remap from="a" to="b"/><remap from="b" to="a"/>{NODE}</launch>', ""),
}


@pytest.fixture(scope="module")
def workspace(tmp_path_factory):
    root = tmp_path_factory.mktemp("bad")
    launch = root / "bad/launch"
    launch.mkdir(parents=True)
    (root / "bad/package.xml").write_text(PACKAGE)
    (root / "bad/bomb.yaml").write_text(BOMB)
    (root / "bad/list.yaml").write_text(LISTS)
    for name, (content, _) in XML.items():
        (launch / f"{name}.launch").write_text(content)
    for name, (statement, given) in GROWING.items():
        (launch / f"{name}.launch.py").write_text(PYTHON % (statement, given))
    for place in range(100):
        inner = f'<include file="$(find bad)/launch/chain{place + 1}.launch"/>' * 3
        (launch / f"chain{place}.launch").write_text(f"<launch>{inner}</launch>")
    (launch / "latin.launch").write_bytes(f"<launch><!-- gr\xfcn -->{NODE}</launch>".encode("latin-1"))
    os.mkfifo(launch / "pipe")
    (launch / "zero").symlink_to("/dev/zero")
    (launch / "loop").symlink_to("loop")
    return root


def limited():
    resource.setrlimit(resource.RLIMIT_CPU, (MOST_CPU_S, MOST_CPU_S))
    resource.setrlimit(resource.RLIMIT_AS, (MOST_BYTES, MOST_BYTES))


PROBE = """
import json, sys
from pathlib import Path
from roslens.source.extract.facts.files import FolderFiles
from roslens.source.extract.launch.launch_ros1 import evaluate_ros1
from roslens.source.extract.launch.launch_ros2 import evaluate_ros2
files = FolderFiles(Path(sys.argv[1]), {"bad": "bad"})
for path in sys.argv[2:]:
    launch = (evaluate_ros2 if path.endswith(".py") else evaluate_ros1)(path, files)
    print(json.dumps([path, len(launch.nodes), [f"{one.text[:80]}: {one.reason}" for one in launch.unresolved]]))
"""


def told(root, *names):
    ran = subprocess.run(
        [sys.executable, "-c", PROBE, str(root), *(f"bad/launch/{name}" for name in names)],
        capture_output=True, text=True, preexec_fn=limited, check=False,
    )  # fmt: skip
    assert ran.returncode == 0, ran.stderr[-2000:]
    return [json.loads(line) for line in ran.stdout.splitlines()]


def test_launch_files_of_ros1(workspace):
    found = told(workspace, *(f"{name}.launch" for name in XML))
    for (path, _, reasons), (_, wanted) in zip(found, XML.values(), strict=True):
        assert not wanted or any(wanted in one for one in reasons), (path, reasons)
        assert all(len(one) < 1_000 for one in reasons), path


def test_launch_files_in_python(workspace):
    found = {
        path: (nodes, reasons) for path, nodes, reasons in told(workspace, *(f"{one}.launch.py" for one in GROWING))
    }
    assert len(found) == len(GROWING)
    for path, (nodes, reasons) in found.items():
        assert nodes or reasons, path


def test_includes_end(workspace):
    ((_, nodes, reasons),) = told(workspace, "chain0.launch")
    assert nodes == 0
    assert "more than 200 files, or 30 levels of includes" in reasons[0]


def test_what_is_not_utf_8_is_told_and_read(workspace):
    ((_, nodes, reasons),) = told(workspace, "latin.launch")
    assert nodes == 1
    assert "UTF-8" in reasons[0]
