"""Where the kernel has no Landlock, bubblewrap confines: what it keeps from a program is tried with the real one."""

import os
import sys

import pytest

from roslens.children.sandbox import BUBBLEWRAP, Sandbox, bubblewrap
from roslens.source.tools.running import run_tool
from roslens.source.tools.running.run_tool import ToolRunner

pytestmark = pytest.mark.skipif(not bubblewrap(), reason="bubblewrap is not installed, or may make no namespaces")


@pytest.fixture
def places(tmp_path, monkeypatch):
    for name in ("workspace", "scratch", "home"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "file").write_text(name)
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    monkeypatch.setattr(run_tool, "sandbox_kind", lambda: BUBBLEWRAP)
    return tmp_path


@pytest.fixture
def confined(places):
    def run(code, *, network=False):
        sandbox = Sandbox(read=(str(places / "workspace"),), write=(str(places / "scratch"),), network=network)
        words = [sys.executable, "-c", code]
        return ToolRunner().run(words, folder=str(places / "workspace"), time_limit_s=60, sandbox=sandbox)

    return run


def test_it_reads_what_it_is_to_look_at_and_writes_its_scratch(places, confined):
    ended = confined("import os; print(open('file').read()); open(os.environ['HOME'] + '/made', 'w').write('x')")
    assert (ended.code, ended.stdout) == (0, b"workspace\n"), ended.stderr
    assert (places / "scratch" / "made").read_text() == "x"


@pytest.mark.parametrize(
    ("code", "refused"),
    [
        ("open('{at}/home/file')", b"FileNotFoundError"),
        ("import os; os.listdir('{at}/home')", b"FileNotFoundError"),
        ("open('file', 'w')", b"Read-only file system"),
        ("open('made', 'w')", b"Read-only file system"),
        ("import os; os.unlink('file')", b"Read-only file system"),
        ("import os; os.rename('file', '{at}/scratch/x')", b"OSError"),
        ("import os; os.link('file', '{at}/scratch/x')", b"OSError"),
        ("import os; os.mkdir('made')", b"Read-only file system"),
        ("import socket; socket.create_connection(('127.0.0.1', 1))", b"OSError|ConnectionRefusedError"),
        ("import socket; socket.create_connection(('192.0.2.1', 80), 5)", b"Network is unreachable"),
        ("import os; os.kill({parent}, 0)", b"ProcessLookupError"),
        ("open('/proc/{parent}/environ')", b"FileNotFoundError"),
    ],
)
def test_nothing_else(places, confined, code, refused):
    ended = confined(code.format(at=places, parent=os.getpid()))
    assert ended.code == 1, (ended.code, ended.stderr)
    assert any(one in ended.stderr for one in refused.split(b"|")), ended.stderr
    assert (places / "workspace" / "file").read_text() == "workspace"


def test_programs_that_it_starts_are_confined_as_well(places, confined):
    ended = confined(f"import subprocess; print(subprocess.run(['/bin/cat', '{places}/home/file']).returncode)")
    assert ended.stdout == b"1\n", ended.stderr


def test_no_module_is_imported_from_what_it_is_to_look_at(places, confined):
    (places / "workspace" / "only_here.py").write_text("print('taken')\n")
    ended = confined("import sys, os; sys.path.insert(0, os.getcwd()); import only_here")
    assert b"ModuleNotFoundError" in ended.stderr
    assert b"taken" not in ended.stdout
