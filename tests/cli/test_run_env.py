import os
import subprocess
import sys

import pytest

from roslens.cli.main import main
from roslens.live.inside import preload
from roslens.live.inside.environment import PATH

pytestmark = pytest.mark.timed

ROSLENS = [sys.executable, "-m", "roslens.cli.main"]


def shell(program: str, **variables: str) -> str:
    plain = {name: text for name, text in os.environ.items() if name not in ("PYTHONPATH", "ROSLENS_COUNTERS")}
    return subprocess.run(
        ["sh", "-euc", program], env={**plain, "ROSLENS": " ".join(ROSLENS), **variables},
        capture_output=True, text=True, check=True, timeout=60,
    ).stdout  # fmt: skip


def test_run_passes_environment_arguments_and_exit_code_on():
    code = "import os, sys; print(os.environ['PYTHONPATH'], sys.argv[1:]); sys.exit(7)"
    ended = subprocess.run(
        [*ROSLENS, "run", "--", sys.executable, "-c", code, "-x", "a b"], capture_output=True, text=True
    )
    assert ended.returncode == 7
    assert ended.stdout.startswith(PATH)
    assert "['-x', 'a b']" in ended.stdout


@pytest.mark.parametrize("command", [[], ["--"]])
def test_run_wants_a_command(command, capsys):
    assert main(["run", *command]) == 2
    assert "expected one after --" in capsys.readouterr().err


def test_run_names_what_it_cannot_start(capsys):
    assert main(["run", "--", "no-such-program"]) == 2
    assert "'no-such-program' cannot be started" in capsys.readouterr().err


def test_a_shell_reads_what_env_prints_and_undoes_it():
    said = shell('eval "$($ROSLENS env)"; echo "$PYTHONPATH"; eval "$($ROSLENS env --undo)"; echo "$PYTHONPATH"; '
                 'echo "${ROSLENS_COUNTERS-gone}"', PYTHONPATH="/it's here")  # fmt: skip
    assert said.splitlines() == [f"{PATH}:/it's here", "/it's here", "gone"]


def test_env_speaks_fish(monkeypatch, capsys):
    monkeypatch.setattr(preload, "library", lambda: None)
    monkeypatch.setenv("PYTHONPATH", "/it's")
    monkeypatch.setenv("ROSLENS_COUNTERS", "/c")
    assert main(["env", "--shell", "fish"]) == 0
    assert capsys.readouterr().out == f"set -gx PYTHONPATH '{PATH}:/it\\'s';\nset -gx ROSLENS_COUNTERS '/c';\n"
    monkeypatch.delenv("PYTHONPATH")
    assert main(["env", "--shell", "fish", "--undo"]) == 0
    assert capsys.readouterr().out == "set -e PYTHONPATH;\nset -e ROSLENS_COUNTERS;\n"


@pytest.mark.parametrize("undo", [[], ["--undo"]])
def test_env_says_what_is_not_counted_without_the_library(undo, monkeypatch, capsys):
    monkeypatch.setattr(preload, "_found", lambda: None)
    assert main(["env", *undo]) == 0
    said = capsys.readouterr()
    assert "LD_PRELOAD" not in said.out
    assert ("Nodes in C++ are not counted" in said.err) is not bool(undo)


def test_run_says_so_too(monkeypatch, capsys):
    monkeypatch.setattr(preload, "_found", lambda: None)

    def replaced(file, *_):
        raise SystemExit(file)  # it never returns

    monkeypatch.setattr(os, "execvpe", replaced)
    with pytest.raises(SystemExit, match="true"):
        main(["run", "--", "true"])
    assert "Nodes in C++ are not counted" in capsys.readouterr().err
