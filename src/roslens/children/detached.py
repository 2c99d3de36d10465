"""Detached processes, which continue after the process that started them ends."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path

from roslens.children.safe_path import NEUTRAL


def start_detached(
    words: Sequence[str], *, program: str, environment: Mapping[str, str], folder: str, output: Path | None = None,
    user: tuple[int, int, tuple[int, ...]] | None = None,
) -> subprocess.Popen[bytes]:  # fmt: skip
    """Start a process in a session of its own.

    Args:
        words: its command line, with its own name first.
        program: the file that is run.
        environment: all of it.
        folder: that it begins in.
        output: where what it prints is appended; None for nowhere.
        user: numbers of user, group and further groups that it is to run as; None for those of this process.

    Raises:
        OSError: it cannot be started.
    """
    flags = os.O_WRONLY | os.O_CREAT | os.O_APPEND | os.O_CLOEXEC | os.O_NOFOLLOW
    written = subprocess.DEVNULL if output is None else os.open(output, flags, 0o600)
    as_user = {} if user is None else {"user": user[0], "group": user[1], "extra_groups": list(user[2])}
    try:
        started: subprocess.Popen[bytes] = subprocess.Popen(
            list(words), executable=program, env=dict(environment), cwd=folder, stdin=subprocess.DEVNULL,
            stdout=written, stderr=subprocess.STDOUT, start_new_session=True, **as_user,
        )  # type: ignore[call-overload] # fmt: skip
    finally:
        if output is not None:
            os.close(written)
    return started


def run_words(words: Sequence[str], timeout_s: float, most_bytes: int = 4_000) -> tuple[int, str]:
    """Run a program without a shell, with nothing of this environment but its path, and return code and last output.

    Raises:
        OSError: it cannot be started.
        subprocess.TimeoutExpired: it did not end in time, and was killed with all that it started.
    """
    kept = {name: os.environ[name] for name in ("PATH", "HOME", "LANG", "USER") if name in os.environ}
    process = subprocess.Popen(
        list(words), env=kept, cwd=NEUTRAL, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, start_new_session=True,
    )  # fmt: skip
    try:
        output, _ = process.communicate(timeout=timeout_s)
    except subprocess.TimeoutExpired:
        _kill_group(process.pid)
        process.communicate()
        raise
    return process.returncode, output[-most_bytes:].decode("utf-8", "replace").strip()


def _kill_group(pid: int) -> None:
    import contextlib
    import signal

    with contextlib.suppress(ProcessLookupError, PermissionError):
        os.killpg(pid, signal.SIGKILL)
