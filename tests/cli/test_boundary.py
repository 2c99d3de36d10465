import errno
from pathlib import Path

import pytest

from roslens.cli.terminal.boundary import BAD_INPUT, BUG, INTERRUPTED, guarded
from roslens.model.errors import UsageError


def raising(error: BaseException):
    def command() -> int:
        raise error

    return command


def test_the_code_of_the_command_is_the_code():
    assert guarded(lambda: 3, []) == 3


def test_an_expected_error_is_one_line_and_no_traceback(capsys: pytest.CaptureFixture[str]):
    assert guarded(raising(UsageError("no folder 'x'", expected="a folder", advice="Name another")), []) == BAD_INPUT
    assert capsys.readouterr().err == "roslens: no folder 'x'; expected a folder. Name another\n"


def test_an_interrupt_is_130(capsys: pytest.CaptureFixture[str]):
    assert guarded(raising(KeyboardInterrupt()), []) == INTERRUPTED
    assert "Traceback" not in capsys.readouterr().err


def test_a_full_disk_says_what_to_do(capsys: pytest.CaptureFixture[str]):
    error = OSError(errno.ENOSPC, "No space left on device", "report.json")
    assert guarded(raising(error), []) == BAD_INPUT
    assert capsys.readouterr().err.startswith("roslens: report.json: No space left on device. Free some space")


def test_a_bug_leaves_a_file_to_attach(capsys: pytest.CaptureFixture[str], tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    assert guarded(raising(ZeroDivisionError("division by zero")), ["check", "x"]) == BUG
    said = capsys.readouterr().err
    (report,) = Path(tmp_path).glob("roslens-bug-*.txt")
    assert str(report) in said
    text = report.read_text("utf-8")
    assert "arguments: ['check', 'x']" in text
    assert "ZeroDivisionError" in text
