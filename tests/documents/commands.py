"""Commands and their results as documents show them, run in a home folder of their own as a reader would."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import time
import urllib.request
from collections.abc import Iterator
from pathlib import Path

import msgspec

ROOT = Path(__file__).parents[2]
WORDS = ("roslens", "sh", "cp", "cd", "git", "python", "python3", "pip", "chmod", "kill", "ros2", "make")
"""What a line of commands begins with."""
_CODE = re.compile(r"(The|the) exit code is (\d)")
_WRITTEN = re.compile(r" -o (\S+\.yaml)")
_ADDRESS = re.compile(r"http://\S+")
WAIT_S = 300


class Block(msgspec.Struct, frozen=True):
    """Lines that a document indents: commands, or what the commands before it print.

    Attributes:
        line: of the first, from 1.
        lines: without the indentation.
        text: the paragraphs between this block and the next.
    """

    line: int
    lines: tuple[str, ...]
    text: str

    @property
    def is_commands(self) -> bool:
        """Whether it is to be typed."""
        return self.lines[0].split()[0] in WORDS

    @property
    def exit_code(self) -> int | None:
        """What the text behind it says of the exit code of its last command."""
        said = _CODE.search(self.text)
        return int(said[2]) if said else None


def blocks(document: str) -> Iterator[Block]:
    """Yield the indented blocks of a document, with the text behind each."""
    lines = document.splitlines()
    starts = [
        number
        for number, line in enumerate(lines)
        if line.startswith("    ") and (number == 0 or not lines[number - 1].strip())
    ]
    for start, following in zip(starts, [*starts[1:], len(lines)], strict=True):
        end = start
        while end < following and lines[end].startswith("    "):
            end += 1
        yield Block(start + 1, tuple(one[4:] for one in lines[start:end]), "\n".join(lines[end:following]))


def without_comment(line: str) -> str:
    """Return a command without what is said of it behind ` #`."""
    return re.split(r"\s+#\s", line, maxsplit=1)[0].rstrip()


def squeezed(text: str) -> str:
    """Return a text in which line ends and other white space are single spaces."""
    return " ".join(text.split())


class Done(msgspec.Struct, frozen=True):
    """What a command printed, on both streams, and how it ended."""

    code: int
    printed: str


class Reader:
    """A home folder with a clone's examples, and a shell in which commands are typed one after another."""

    def __init__(self, home: Path) -> None:
        self.home = home
        self.place = home / "roslens"
        shutil.copytree(ROOT / "examples", self.place / "examples", ignore=shutil.ignore_patterns(".roslens"))
        programs = home / ".programs"
        programs.mkdir()
        (programs / "roslens").write_text(f'#!/bin/sh\nexec "{sys.executable}" -m roslens "$@"\n')
        (programs / "python").write_text(f'#!/bin/sh\nexec "{sys.executable}" "$@"\n')
        for program in programs.iterdir():
            program.chmod(0o755)
        who = {f"GIT_{role}_{what}": "a@b.c" for role in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}
        self.environment = {
            **os.environ, **who, "HOME": str(home), "XDG_CONFIG_HOME": str(home / ".config"),
            "PATH": f"{programs}:{os.environ['PATH']}", "GIT_CONFIG_GLOBAL": "/dev/null", "NO_COLOR": "1",
        }  # fmt: skip

    def type(self, command: str) -> Done:
        """Run a command where the last one left the shell; what serves pages is asked for one and ended."""
        if command.startswith("roslens serve") or " --serve " in command:
            return self._served(command)
        last = self.home / ".place"
        done = subprocess.run(
            ["bash", "-c", f"{command}\ncode=$?\npwd >{last}\nexit $code"],
            cwd=self.place, env=self.environment, capture_output=True, text=True, timeout=WAIT_S, check=False,
            stdin=subprocess.DEVNULL,
        )  # fmt: skip
        written = _WRITTEN.search(command)
        content = self.place / written[1] if written else None
        self.place = Path(last.read_text().strip())
        kept = content.read_text("utf-8") if content and content.is_file() else ""
        return Done(done.returncode, done.stdout + done.stderr + kept)

    def some_finding(self, workspace: str = "") -> str:
        """Return the fingerprint of a finding of the last run of a workspace."""
        done = self.type(f"roslens check {workspace} --format json -q --fail-on never 2>/dev/null")
        return str(json.loads(done.printed)["findings"][0]["fingerprint"])

    def _served(self, command: str) -> Done:
        words = re.sub(r"--serve \d+", "--serve 0", command) if " --serve " in command else f"{command} --port 0"
        with subprocess.Popen(
            ["bash", "-c", f"exec {words}"], cwd=self.place, env=self.environment, stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
        ) as serving:  # fmt: skip
            printed = ""
            try:
                assert serving.stderr is not None
                until = time.monotonic() + WAIT_S
                while not (address := _ADDRESS.search(printed)) and time.monotonic() < until:
                    line = serving.stderr.readline()
                    if not line:
                        break
                    printed += line
                assert address, printed
                with urllib.request.urlopen(address[0], timeout=WAIT_S) as page:
                    printed += page.read().decode()
            finally:
                serving.terminate()
                serving.wait(WAIT_S)
        return Done(serving.returncode, printed)
