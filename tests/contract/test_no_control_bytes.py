"""No output has a raw control byte of the source in it: a terminal that shows a report would obey it.

Every command with ``--format``, and every format of it, over a workspace whose names and texts hold control characters.
A format or a command that is added comes in by itself, or is named here with the reason why it stays out.
"""

import argparse
import re
import subprocess
import sys

import pytest

from roslens.cli.main import main, parser
from roslens.report.run.formats import FORMATS as RUN_FORMATS

ESC = "\x1b[31mX\x07\x08\x7f\x9b2J"
RAW = re.compile(rb"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f]|\xc2[\x80-\x9f]|\r(?!\n)")
"""What is left of C0 without tab, line feed and the ends of lines of CSV, DEL, and C1 in UTF-8."""
NOT_HERE = {
    "watch": "a running system or a recording, where names have the alphabet of ROS",
    "history": "of a running system; and of past revisions, where names are those of packages",
    "study": "numbers of many workspaces",
}
MANIFEST = """<package format="3"><name>arm</name><version>1.0.0</version><description>An \x7f\x9b arm.</description>
<maintainer email="a@b.cc">A\x9b2JB</maintainer><license>MIT\x9b</license><depend>no_such\x9b_one</depend>
<depend>rclpy</depend><export><build_type>ament_python</build_type></export></package>
"""
NODE = f"""import rclpy
from rclpy.node import Node
from std_msgs.msg import String
class A(Node):
    def __init__(self):
        super().__init__('a{ESC}')
        self.p = self.create_publisher(String, '/t{ESC}', 10)
        self.s = self.create_subscription(String, '/u{ESC}', self.c, 10)
        self.declare_parameter('p{ESC}', 'v{ESC}')
    def c(self, m):
        password = "hunter2{ESC}"
        open("/home/u{ESC}/x")
def main():
    rclpy.init()
    rclpy.spin(A())
"""
CODE = f"""#include "x{ESC}.h"
// TODO {ESC} fix
int f(int a) {{ int unused{ESC}; goto x{ESC}; return 0; }}
int g(int a) {{ {"if (a) h(); " * 40} return 0; }}
"""
SETUP = f"""from setuptools import setup
setup(name='arm', entry_points={{'console_scripts': ['a = nodes.a:main', 'b = b:main{ESC}']}})
"""
LAUNCH = """<launch><node pkg="arm" exec="a" name="n\x9b2J" namespace="/\x7f"><param name="p\x9b" value="\x9b"/>
<remap from="/t" to="/\x9b2J"/></node><include file="$(find-pkg-share no\x9b)/x.launch.xml"/></launch>
"""


@pytest.fixture(scope="module")
def workspace(tmp_path_factory):
    root = tmp_path_factory.mktemp("hostile")
    package = root / f"arm{ESC}"
    for folder in ("launch", "nodes", "msg"):
        (package / folder).mkdir(parents=True)
    (package / "package.xml").write_text(MANIFEST)
    (package / "CMakeLists.txt").write_text(f'cmake_minimum_required(VERSION 3.8)\nadd_executable(a "a{ESC}.cpp")\n')
    (package / f"a{ESC}.cpp").write_text(CODE)
    (package / f"a{ESC}.py").write_text(NODE)
    (package / f"b{ESC}.py").write_text(f"def f(:\n    {ESC}\n")
    (package / "nodes" / "__init__.py").write_text("")
    (package / "nodes" / "a.py").write_text(NODE)
    for name in ("c", "d"):
        (package / "launch" / f"{name}.launch.xml").write_text(LAUNCH.replace('name="n', f'name="{name}'))
    (package / "launch" / f"l{ESC}.launch.xml").write_text(LAUNCH)
    (package / "setup.py").write_text(SETUP)
    (package / "msg" / "M.msg").write_text(f"int32 a{ESC}\nnone{ESC} b\n")
    (root / "broken").mkdir()
    (root / "broken" / "package.xml").write_text(f"<package><name>{ESC}</name>")
    main(["check", str(root), "-q", "--jobs", "1", "--fail-on", "never"])
    return root


def commands():
    verbs = next(one for one in parser()._actions if isinstance(one, argparse._SubParsersAction))
    return verbs.choices.items()


def formats():
    for verb, one in commands():
        for action in one._actions:
            if "--format" in action.option_strings and verb not in NOT_HERE:
                yield from ((verb, name) for name in action.choices or RUN_FORMATS)


WORDS = {
    "check": ["check", ".", "-q", "--jobs", "1", "--fail-on", "never", "--no-store"],
    "graph": ["graph", ".", "-q", "--launch", "arm/c.launch.xml"],
    "interfaces": ["interfaces", ".", "-q"],
    "port": ["port", "humble", "lyrical", ".", "-q"],
    "roles": ["roles", "."],
    "percentile": ["percentile", "."],
    "evidence": ["evidence", "arm"],
    "plugins": ["plugins", "."],
    "trend": ["trend", "code_lines", "."],
    "graph-markdown": ["graph", ".", "-q", "--diff", "arm/c.launch.xml", "arm/d.launch.xml"],
    "compare": ["compare", "arm/c.launch.xml", "arm/c.launch.xml", "--notes"],
}
FILES = {verb for verb, one in commands() if any("--output" in action.option_strings for action in one._actions)}
SHOWN = {("check", "json"), ("check", "github"), ("check", "text"), ("graph", "dot"), ("graph", "json")}
"""Formats of which a second process tells that standard output is as files are."""


@pytest.mark.parametrize(("verb", "name"), list(formats()))
def test_no_format_of_a_command_has_one(workspace, tmp_path, monkeypatch, capfdbinary, verb, name):
    monkeypatch.chdir(workspace)
    words = [*WORDS.get(f"{verb}-{name}", WORDS[verb]), "--format", name]
    target = tmp_path / "out"
    code = main([*words, "-o", str(target)] if verb in FILES else words)
    printed = capfdbinary.readouterr()
    if verb == "trend":  # there are no past revisions, and the message says so with the name of the folder
        assert b"no past revisions" in printed.err
        return
    assert verb not in FILES or target.exists(), (code, printed.err)
    files = target.rglob("*") if target.is_dir() else [target]
    written = b"".join(one.read_bytes() for one in files) if verb in FILES else printed.out
    assert written, (code, printed.err)
    assert raw_bytes(written, printed.out, printed.err) == []


@pytest.mark.parametrize(("verb", "name"), sorted(SHOWN))
def test_standard_output_has_none(workspace, verb, name):
    words = [*WORDS[verb], "--format", name]
    code = "import sys; from roslens.cli.entry import main; sys.exit(main())"
    done = subprocess.run([sys.executable, "-c", code, *words], capture_output=True, check=False, cwd=workspace)
    assert b"2J" in done.stdout, done.stderr
    assert raw_bytes(done.stdout, done.stderr) == []


@pytest.mark.parametrize("words", [["-o"], ["--single-file"]])
def test_no_page_of_a_report_has_one(workspace, tmp_path, monkeypatch, words):
    monkeypatch.chdir(workspace)
    assert main(["report", ".", "-q", *words, str(tmp_path / "report")]) == 0
    pages = [tmp_path / "report"] if words[0] != "-o" else sorted((tmp_path / "report").rglob("*"))
    pages = [one for one in pages if one.is_file()]
    texts = [one.read_bytes() for one in pages if one.suffix in ("", ".html", ".json", ".csv", ".js", ".css")]
    assert any(b"2J" in one for one in texts)
    assert raw_bytes(*texts) == []


def raw_bytes(*texts):
    return sorted({(text[max(0, one.start() - 30) : one.end()]) for text in texts for one in RAW.finditer(text)})[:9]
