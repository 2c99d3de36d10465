"""No control character of a workspace reaches who reads what roslens writes, in any format, on screen or in a file."""

import contextlib
import os
import re
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from roslens.cli.commands import evidence, graph
from roslens.report.run.formats import FORMATS

CONTROLS = re.compile(rb"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f]|\xc2[\x80-\x9f]|\r(?!\n)")
OBEYED = re.compile(
    rb"[\x00-\x07\x0b\x0c\x0e-\x1a\x1c-\x1f\x7f]|\xc2[\x80-\x9f]|\x1b[^\[]|\x1b\[2J|\r(?!\r?\n|\x1b\[K)"
)
"""What a terminal must not be sent: it is sent colours, and its progress is written over."""

NASTY = "x\x1b]0;t\x07\x1b[2J\x9b2J\x7f\ry"
"""A title for the window, the screen made empty in two ways, delete, and a return that lets a line hide its begin."""

MANIFEST = """<package format="3"><name>arm</name><version>1.0.0</version><description>{0}</description>
<maintainer email="a@b.cc">{0}</maintainer><license>{0}</license><url>http://a/{0}</url><depend>rclcpp</depend>
<export><build_type>ament_cmake</build_type></export></package>
"""
SOURCE = """#include <rclcpp/rclcpp.hpp>
#include "{0}.h"
int main(int c, char** v) {{ rclcpp::init(c, v); auto n = rclcpp::Node::make_shared("n{0}"); int unused{0};
  auto p = n->create_publisher<std_msgs::msg::String>("t{0}", 10); char* a = (char*)"{0}"; goto {0}; rclcpp::spin(n); }}
"""
LAUNCH = """<launch><node pkg="arm" exec="plain"/>
<node pkg="arm" exec="arm" name="{1}" output="{1}"><param name="{1}" value="{1}"/>
<remap from="{1}" to="{1}"/></node><node pkg="{1}" exec="{1}"/><include file="{1}"/></launch>
"""
PYTHON = """import rospy
def {0}(a=[]):
    rospy.init_node("{0}")
    print(undefined_name, "{0}")
    return rospy.Publisher("{0}", String)
"""


@pytest.fixture(scope="module")
def workspace(tmp_path_factory):
    """Return a workspace with control characters in all that is named, as far as its readers take them."""
    root = tmp_path_factory.mktemp("ws")
    package = root / "arm"
    (package / "launch").mkdir(parents=True)
    (package / "package.xml").write_text(MANIFEST.format("x&#x9b;y&#x7f;"))
    (package / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.8)\nproject(arm)\nfind_package(rclcpp)\nadd_executable(arm a.cpp)\n"
        "add_executable(plain plain.cpp)\ninstall(TARGETS arm plain)\n"
        f'set(x "{NASTY}")\nadd_executable("b{NASTY}" "gone{NASTY}.cpp")\nmessage({NASTY})\n'
    )
    (package / "a.cpp").write_text(SOURCE.format(NASTY))
    (package / "plain.cpp").write_text(SOURCE.format("plain"))
    (package / f"b{NASTY}.cpp").write_text(SOURCE.format("plain"))
    (package / "c.py").write_text(PYTHON.format("plain") + f"x = '{NASTY}'\nraise '{NASTY}'\n")
    (package / f"d{NASTY}.py").write_text(PYTHON.format("other") + "def f(:\n")
    (package / "launch" / "a.launch.xml").write_text(LAUNCH.format("", "x&#x9b;y&#x7f;"))
    (package / "launch" / f"b{NASTY}.launch.xml").write_text(LAUNCH.format("", "plain"))
    (package / "launch" / "a.yaml").write_text('"/n\\e[31m": {ros__parameters: {"a\\a": "b\\e"}}\n')
    roslens(root, "check", ".", "-q")
    return root


def roslens(workspace, *words, **how):
    """Run the command in the workspace."""
    return subprocess.run(
        [sys.executable, "-m", "roslens", *words],
        check=False, timeout=300, cwd=workspace,
        env={**os.environ, "XDG_CONFIG_HOME": str(workspace.parent / "user"), "PYTHONSAFEPATH": "1"},
        **(how or {"capture_output": True}),
    )  # fmt: skip


@pytest.fixture
def asked(workspace, tmp_path):
    """Return what asks a command about the workspace and returns all bytes that it wrote, to where it may."""

    def ask(*words, out=""):
        place = tmp_path / (out or "out")
        option = () if words[-1] == "--single-file" else ("-o",)
        done = roslens(workspace, *words, *((*option, str(place)) if out else ()))
        assert done.returncode in (0, 1, 3), done.stderr
        files = [path for path in (place, *place.rglob("*")) if path.is_file()] if place.exists() else []
        assert bool(files) == bool(out)
        return {"stdout": done.stdout, "stderr": done.stderr} | {str(path): path.read_bytes() for path in files}

    return ask


def found(written):
    """Return the first control character of each output, with what is around it."""
    return {
        name: content[max(0, match.start() - 60) : match.end() + 20]
        for name, content in written.items()
        if (match := CONTROLS.search(content)) and Path(name).suffix not in (".png", ".woff2", ".ico", ".gz", ".sqlite")
    }


GRAPH = ("graph", ".", "--launch", "arm/launch/a.launch.xml")
GRAPHS = [name for name in graph.FORMATS if name != "markdown"]  # which is of differences alone
WAYS = [
    *(("check", ".", "--no-store", "--no-color", "--format", name) for name in sorted(FORMATS)),
    *((*GRAPH, "--format", name) for name in GRAPHS),
    ("graph", ".", "--check"),
    *(("evidence", "arm", "--format", name) for name in evidence.FORMATS),
]


@pytest.mark.heavy
@pytest.mark.parametrize("words", WAYS, ids=" ".join)
def test_on_the_screen(words, asked):
    assert found(asked(*words)) == {}


FILES = [
    *(("check", ".", "--no-store", "--format", name) for name in ("csv", "json", "markdown")),
    *((*GRAPH, "--format", name) for name in ("dot", "svg")),
    ("report", "."),
    ("report", ".", "--single-file"),
]


@pytest.mark.heavy
@pytest.mark.parametrize("words", FILES, ids=" ".join)
def test_in_a_file(words, asked):
    assert found(asked(*words, out="out")) == {}


@pytest.mark.heavy
@pytest.mark.parametrize(
    "words", [("check", ".", "--no-store"), ("check", ".", "-v", "--no-cache"), ("graph", "."), GRAPH], ids=" ".join
)
def test_on_a_terminal(words, workspace):
    ours, theirs = os.openpty()
    written = []

    def read():
        with contextlib.suppress(OSError):
            while piece := os.read(ours, 1 << 16):
                written.append(piece)

    reader = threading.Thread(target=read)
    reader.start()
    try:
        roslens(workspace, *words, stdin=theirs, stdout=theirs, stderr=theirs)
    finally:
        os.close(theirs)
        reader.join()
        os.close(ours)
    content = b"".join(written)
    assert b"arm" in content
    assert (match := OBEYED.search(content)) is None, content[max(0, match.start() - 80) : match.end() + 20]
