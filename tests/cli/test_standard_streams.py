"""However standard streams are, the exit code says what became of the output, and no traceback is shown."""

import codecs
import json
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from pace import slowness

from roslens.cli.terminal.standard_streams import escaped

ROSLENS = [sys.executable, "-c", "import sys; from roslens.cli.entry import main; sys.exit(main())"]
WORDS = ["explain", "ros.cyclomatic_complexity.max"]
"""Quick, and says something."""

MANIFEST = (
    "<package format='2'><name>arm</name><version>1.0.0</version><description>d</description>"
    "<maintainer email='a@example.org'>a</maintainer><license>BSD-3-Clause</license></package>"
)
pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="/dev/full is of Linux")


def shell(line: str, *words: str, **environment: str) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run(
        ["sh", "-c", line, "sh", *ROSLENS, *words], capture_output=True, check=False, timeout=120,
        env={**os.environ, **environment},
    )  # fmt: skip


@pytest.mark.parametrize("words", [WORDS, ["--version"]])
def test_a_full_and_a_closed_output_is_told(words: list[str]):
    for redirection, reason in ((">/dev/full", b"No space left on device"), (">&-", b"Bad file descriptor")):
        done = shell(f'"$@" {redirection}', *words)
        assert done.returncode == 74
        assert done.stderr.startswith(b"roslens: standard output could not be written: " + reason)
        assert done.stderr.count(b"\n") == 1


def test_a_result_that_is_written_as_bytes_tells_a_full_output_too(tmp_path: Path):
    (tmp_path / "package.xml").write_text(MANIFEST)
    done = shell('"$@" >/dev/full', "check", str(tmp_path), "-q", "--no-store", "--no-cache", "--format", "json")
    assert done.returncode == 74
    assert (
        done.stderr
        == b"roslens: standard output could not be written: No space left on device. Write to a file with -o\n"
    )


def test_who_reads_no_further_hears_nothing_more():
    done = shell('{ "$@"; echo $? >&2; } | true', *WORDS)
    assert done.stderr == b"141\n"


def test_messages_that_cannot_be_written_change_no_result():
    done = shell('"$@" 2>&-', *WORDS)
    assert done.returncode == 0
    assert done.stdout == shell('"$@" 2>/dev/full', *WORDS).stdout != b""


def test_an_encoding_without_the_letters():
    words = ["explain", "ä😀"]
    done = shell('"$@"', *words, PYTHONIOENCODING="ascii")
    assert done.returncode == 2
    assert rb"\u00e4\ud83d\ude00" in done.stderr


def test_letters_are_escaped_as_in_json():
    text = "ä😀\udcff"
    assert json.loads(f'"{text.encode("ascii", _as_written()).decode()}"') == text


def _as_written() -> str:
    codecs.register_error("as_written", escaped)
    return "as_written"


BEGUN = [
    sys.executable,
    "-c",
    "import os, sys; from roslens.cli.entry import main; os.write(2, b'!'); sys.exit(main())",
]
"""Says when it begins: before, Python itself answers an interrupt, by a traceback."""


def interrupted(folder: Path, moments_s: list[float]) -> None:
    """Interrupt a check at moments: it ends at once, says so in one line or nothing, and so do its workers."""
    for number in range(2):
        package = folder / f"p{number}"
        package.mkdir()
        (package / "package.xml").write_text(MANIFEST.replace("arm", f"p{number}"))
        (package / "a.cpp").write_text("int f(int a) { return a ? 1 : 0; }\n" * 20)
    words = [*BEGUN, "check", str(folder), "--jobs", "2", "-q", "--no-store", "--no-cache"]
    for moment in moments_s:
        with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True) as process:
            assert process.stderr is not None
            assert process.stderr.read(1) == b"!"
            time.sleep(0.01 + moment)
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGINT)
            _, said = process.communicate(timeout=120)
        assert b"Exception ignored" not in said, (moment, said)
        assert b"Traceback" not in said, (moment, said)
        # A shell says 130 of what the signal itself ends, too.
        assert process.returncode in {0, 1, 3, 130, -signal.SIGINT}, (moment, said)


@pytest.mark.timed
def test_an_interrupt_at_any_moment(tmp_path: Path):
    interrupted(tmp_path, [0.2, 0.7])


@pytest.mark.timed
@pytest.mark.nightly
def test_an_interrupt_at_any_of_three_hundred_moments(tmp_path: Path):
    chance = random.Random(21)
    interrupted(tmp_path, [chance.random() * 1.5 * slowness() for _ in range(300)])
