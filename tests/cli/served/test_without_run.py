"""A recording is shown where no source was checked: its pages alone."""

from __future__ import annotations

import argparse
import re
import signal
import subprocess
import sys
import urllib.request
from pathlib import Path

import pytest

from roslens.cli.main import main
from roslens.cli.served.without_run import needs_no_run
from roslens.cli.workplace.workplace import own_folder

EXAMPLE = Path(__file__).parents[3] / "examples/recording"


def options(path: Path, **given: object) -> argparse.Namespace:
    base = {"no_store": False, "changed": False, "number": None, "against": None, "accept": False}
    shown = {"live": False, "bag": None, "history": None}
    return argparse.Namespace(path=str(path), **{**base, **shown, **given})


def test_only_what_runs_or_was_recorded_needs_no_run(tmp_path: Path) -> None:
    assert needs_no_run(options(tmp_path, bag=["a.bag"]))
    assert needs_no_run(options(tmp_path, live=True))
    assert not needs_no_run(options(tmp_path))
    assert not needs_no_run(options(tmp_path, bag=["a.bag"], accept=True))
    (own_folder(tmp_path) / "store.sqlite").touch()
    assert not needs_no_run(options(tmp_path, bag=["a.bag"]))


def test_without_anything_to_show_a_run_is_asked_for(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["serve", str(tmp_path)]) == 2
    assert "Run `roslens check" in capsys.readouterr().err


@pytest.mark.real
def test_a_recording_alone(tmp_path: Path) -> None:
    bag = tmp_path / "rover_drive"
    subprocess.run([sys.executable, EXAMPLE / "record.py", bag], check=True, capture_output=True)
    words = [
        sys.executable,
        "-m",
        "roslens",
        "serve",
        "--bag",
        bag,
        "--reference",
        EXAMPLE / "rover.yaml",
        "--port",
        "0",
    ]
    with subprocess.Popen(words, cwd=tmp_path, stderr=subprocess.PIPE, text=True) as serving:
        try:
            assert serving.stderr is not None
            told = serving.stderr.readline()
            address = re.search(r"http://\S+", serving.stderr.readline())
            assert address is not None
            with urllib.request.urlopen(address[0], timeout=60) as page:
                assert "rover_drive" in page.read().decode()
        finally:
            serving.send_signal(signal.SIGTERM)
            serving.wait(60)
    assert "no source was checked here" in told
    assert "`roslens check .` makes them" in told
    assert serving.returncode == 0
