"""Whatever a program does, it ends, and the message says how."""

import time

import pytest

from roslens.source.tools.running.run_tool import ToolError, ToolRunner, ended_how

SHELL = "/bin/sh"


def run(script, *, limit=20.0, most=1_000_000, folder="/"):
    return ToolRunner(most_bytes=most).run([SHELL, "-c", script], folder=folder, time_limit_s=limit)


def test_what_it_leaves(tmp_path):
    ended = run("echo out; echo err >&2; pwd; exit 3", folder=str(tmp_path))
    assert (ended.code, ended.stdout, ended.stderr) == (3, f"out\n{tmp_path}\n".encode(), b"err\n")


def test_a_hang_ends_with_all_it_started():
    begun = time.monotonic()
    with pytest.raises(ToolError, match=r"did not end within 0\.3 s"):
        run("sleep 60 & sleep 60", limit=0.3)
    assert time.monotonic() - begun < 20


def test_too_much_output_is_not_kept():
    with pytest.raises(ToolError, match="printed more than 1,000,000 bytes"):
        run("while :; do echo 0123456789012345678901234567890123456789; done")


def test_a_crash_is_named():
    assert ended_how(run("kill -SEGV $$").code) == "was ended by SIGSEGV"


def test_nothing_is_imported_from_the_folder(tmp_path):
    (tmp_path / "os.py").write_text("raise SystemExit(99)")
    assert run("exit 0", folder=str(tmp_path)).code == 0
