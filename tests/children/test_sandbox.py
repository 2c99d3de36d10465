"""In a sandbox a program reads what it is to look at, writes its scratch, and reaches nothing else."""

import os
import subprocess
import sys

import pytest

from roslens.children.sandbox import LANDLOCK, Sandbox, is_narrow, program_folders, sandbox_kind
from roslens.source.tools.running.run_tool import ToolRunner

pytestmark = pytest.mark.skipif(sandbox_kind() != LANDLOCK, reason="this kernel has no Landlock")


@pytest.fixture
def places(tmp_path, monkeypatch):
    """Return a workspace, a scratch and a home, of which the first two are for the program."""
    for name in ("workspace", "scratch", "home"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "file").write_text(name)
    (tmp_path / "workspace" / "script").write_text("#!/bin/sh\necho started\n")
    (tmp_path / "workspace" / "script").chmod(0o755)
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    return tmp_path


@pytest.fixture
def confined(places):
    """Return what runs Python in the sandbox."""

    def run(code):
        sandbox = Sandbox(read=(str(places / "workspace"),), write=(str(places / "scratch"),))
        words = [sys.executable, "-c", code]
        return ToolRunner().run(words, folder=str(places / "workspace"), time_limit_s=60, sandbox=sandbox)

    return run


def refused(ended):
    """Tell whether a program was refused access, and not stopped by anything else."""
    return ended.code == 1 and (b"PermissionError" in ended.stderr or b"cross-device" in ended.stderr)


def test_it_reads_what_it_is_to_look_at_and_writes_its_scratch(places, confined):
    ended = confined("import os; print(open('file').read()); open(os.environ['HOME'] + '/made', 'w').write('x')")
    assert (ended.code, ended.stdout) == (0, b"workspace\n"), ended.stderr
    assert (places / "scratch" / "made").read_text() == "x"


@pytest.mark.parametrize(
    "code",
    [
        "open('{at}/home/file')",
        "import os; os.listdir('{at}/home')",
        "open('file', 'w')",
        "open('made', 'w')",
        "import os; os.unlink('file')",
        "import os; os.rename('file', '{at}/scratch/x')",
        "import os; os.link('file', '{at}/scratch/x')",
        "import os; os.mkdir('made')",
        "open('{at}/made', 'w')",
        "import socket; socket.socket()",
        "import socket; socket.socket(socket.AF_UNIX)",
        "import socket; socket.create_connection(('127.0.0.1', 1))",
        "import os; os.kill({parent}, 0)",
        "open('/proc/{parent}/environ')",
        "import os; os.execv('./script', ['script'])",
        "import subprocess; subprocess.run(['{at}/workspace/script'])",
    ],
)
def test_nothing_else(places, confined, code):
    ended = confined(code.format(at=places, parent=os.getpid()))
    assert refused(ended), (ended.code, ended.stderr)
    assert (places / "workspace" / "file").read_text() == "workspace"


def test_programs_that_it_starts_are_confined_as_well(places, confined):
    ended = confined(f"import subprocess; print(subprocess.run(['/bin/cat', '{places}/home/file']).returncode)")
    assert ended.stdout == b"1\n"


def test_no_module_is_imported_from_what_it_is_to_look_at(places, confined):
    (places / "workspace" / "colorsys.py").write_text("print('taken')\n")
    (places / "workspace" / "only_here.py").write_text("print('taken')\n")
    put_first = "import sys; sys.path.insert(0, '.'); sys.path.insert(0, __import__('os').getcwd()); "
    ended = confined(put_first + "import colorsys; print(colorsys.__file__)")
    assert ended.code == 0
    assert b"taken" not in ended.stdout
    assert b"ModuleNotFoundError" in confined(put_first + "import only_here").stderr


def test_folders_of_a_program_do_not_hold_the_home(places, monkeypatch):
    folder = places / "home" / "bin"
    folder.mkdir()
    program = folder / "tool"
    program.write_text(f"#!{sys.executable}\n")
    found = program_folders(str(program))
    assert str(folder) in found
    assert str(places / "home") not in found
    assert sys.prefix in found or os.path.realpath(sys.prefix) in map(os.path.realpath, found)
    assert not any(is_narrow(path) for path in ("/", str(places), str(places / "home"), "relative"))


def test_what_the_kernel_refuses_ends_the_program_before_it_begins(places):
    code = (
        "from roslens.children import landlock, sandbox\n"
        "def refuse(*_, **__): raise OSError(1, 'refused')\n"
        "sandbox.restrict = refuse\n"
        "sandbox.confine(sandbox.Sandbox())\n"
        "print('went on')\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, check=False)
    assert done.returncode == 1
    assert b"went on" not in done.stdout
