"""What the command line says to words that it does not know."""

import subprocess
import sys

import pytest

from roslens.cli.main import main, parser
from roslens.cli.terminal.command_parser import take_late_words


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["graph", "--lanch", "x"], ["--lanch", "Did you mean --launch?", "`roslens graph --help`"]),
        (["watch", "--taps=x"], ["--taps=x", "Did you mean --tap?", "`roslens watch --help`"]),
        (["check", "--zzz"], ["--zzz", "`roslens check --help`"]),
        (["reference", "check", "a", "--grph=x"], ["Did you mean --graph?", "`roslens reference check --help`"]),
        (["--verzion"], ["--verzion", "Did you mean --version?", "`roslens --help`"]),
        (["chek"], ["there is no command 'chek'. Did you mean check?", "`roslens --help`"]),
        (["SERVE"], ["there is no command 'SERVE'. Did you mean serve?"]),
        (["reference", "drft"], ["there is no action 'drft'. Did you mean draft?", "`roslens reference --help`"]),
        (["check", "--fail-on", "eror"], ["--fail-on", "'eror'", "Did you mean error?"]),
    ],
)
def test_an_unknown_argument_is_named_with_what_comes_near(words, said, capsys):
    with pytest.raises(SystemExit, match="2"):
        main(words)
    error = capsys.readouterr().err
    assert [part for part in said if part not in error] == []


@pytest.mark.parametrize("words", [["check", "--zzz"], ["zzz"], ["check", "--fail-on", "zzz"], []])
def test_nothing_near_is_not_guessed(words, capsys):
    with pytest.raises(SystemExit, match="2"):
        main(words)
    error = capsys.readouterr().err
    assert error
    assert "Did you mean" not in error


def test_what_a_command_of_the_user_gets_is_not_ours():
    words = [sys.executable, "-m", "roslens.cli.main", "run", "--", "echo", "--lanch"]
    assert subprocess.run(words, capture_output=True, text=True, check=True).stdout == "--lanch\n"


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["trend", "loc", "--format", "csv", "WS"], {"quantity": "loc", "path": "WS", "format": "csv"}),
        (["trend", "loc", "WS", "--format", "csv"], {"quantity": "loc", "path": "WS", "format": "csv"}),
        (["check", "--format", "json", "A", "B"], {"paths": ["A", "B"]}),
        (["explain", "--config", "x.toml", "loc", "WS"], {"id": "loc", "path": "WS"}),
    ],
)
def test_words_after_options_are_taken(words, expected):
    top = parser(words[0])
    options, unknown = top.parse_known_args(words)
    assert take_late_words(unknown, top, options) == []
    assert {key: getattr(options, key) for key in expected} == expected


@pytest.mark.parametrize("words", [["trend", "loc", "A", "--format", "csv", "B"], ["trend", "loc", "--x", "A"]])
def test_words_that_nothing_takes_are_refused(words, capsys):
    with pytest.raises(SystemExit, match="2"):
        main(words)
    assert "unrecognized arguments" in capsys.readouterr().err


@pytest.mark.parametrize("verb", ["percentile", "report", "trend"])
def test_a_folder_that_does_not_exist_is_refused(verb, tmp_path, capsys, monkeypatch):
    (tmp_path / "robot").mkdir()
    monkeypatch.chdir(tmp_path)
    words = [verb, "loc", "robbot"] if verb == "trend" else [verb, "robbot"]
    assert main(words) == 2
    error = capsys.readouterr().err
    assert "there is no folder 'robbot'" in error
    assert "Did you mean 'robot'?" in error


def test_the_module_is_the_command():
    words = [sys.executable, "-m", "roslens", "--version"]
    assert subprocess.run(words, capture_output=True, text=True, check=True).stdout.startswith("roslens ")
