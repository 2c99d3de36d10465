"""The command that writes the tables of signatures, on a small library with a branch for each of two distributions."""

import subprocess

from launch_signatures.library import read_library
from launch_signatures.table import table

ACTION = "class Action:\n    def __init__(self, *, condition=None): pass\n"
OLD = (
    "from ..action import Action\n\n\nclass Start(Action):\n"
    "    def __init__(self, cmd, *, env=None, old=None, **kwargs):\n        super().__init__(**kwargs)\n\n\n"
    "class Run(Start):\n"
    "    def __init__(self, *, program, **kwargs):\n        super().__init__(cmd=program, **kwargs)\n"
)
NEW = OLD.replace(" old=None,", " fresh=None,")


def write(folder, files):
    for name, text in files.items():
        path = folder / "launch" / "launch" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


def git(folder, *arguments):
    who = ("-c", "user.name=a", "-c", "user.email=a@example.org")
    subprocess.run(("git", *who, *arguments), cwd=folder, check=True, capture_output=True)


def test_a_table_has_inherited_keywords_and_spans(tmp_path):
    git(tmp_path, "init", "-q", "-b", "foxy")
    common = {"__init__.py": "from . import actions\n", "action.py": ACTION}
    exports = {"actions/__init__.py": "from .start import Start, Run\n"}
    write(tmp_path, {**common, **exports, "actions/start.py": OLD})
    git(tmp_path, "add", ".")
    git(tmp_path, "commit", "-q", "-m", "a")
    git(tmp_path, "checkout", "-q", "-b", "humble")
    write(tmp_path, {"actions/start.py": NEW})
    git(tmp_path, "commit", "-q", "-a", "-m", "b")
    read = {one: read_library(tmp_path, one, "launch") for one in ("foxy", "humble")}
    lines = list(table(read, "launch"))
    run = lines[lines.index('[classes."launch.actions.Run"]') :]
    assert run[1:8] == [
        'defined = "launch.actions.start.Run"',
        'kind = "action"',
        "positional = []",
        'required = ["program"]',
        'keywords = ["program", "env", "condition"]',
        'at.old = "-foxy"',
        'at.fresh = "humble-"',
    ]
    assert '"launch.actions.start" = ""' in lines
