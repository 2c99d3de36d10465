"""`roslens serve --new-token`: a token on standard output, and its line in the file."""

import pytest

from roslens.cli.main import main
from roslens.cli.terminal.boundary import BAD_INPUT, CLEAN
from roslens.dashboard.access.person import Person, Role
from roslens.dashboard.access.tokens import read_tokens


def test_a_new_token_is_printed_and_added(tmp_path, capsys):
    path = tmp_path / "people.txt"
    assert main(["serve", "--new-token", "operate", "otto", "--tokens", str(path)]) == CLEAN
    token = capsys.readouterr().out.strip()
    assert read_tokens(path) == {token: Person("otto", Role.OPERATE)}


def test_without_a_file_it_is_only_printed(capsys):
    assert main(["serve", "--new-token", "view", "vera"]) == CLEAN
    printed = capsys.readouterr()
    assert printed.out.startswith("rlt_")
    assert "the line `view vera TOKEN` in the file of --tokens" in printed.err


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["admin", "otto"], "the role 'admin'; expected view or operate"),
        (["view", "a b"], "the name 'a b'; expected one word"),
    ],
)
def test_what_is_wrong_is_said(words, said, capsys):
    assert main(["serve", "--new-token", *words]) == BAD_INPUT
    assert said in capsys.readouterr().err


def test_a_file_that_cannot_be_written_is_named(tmp_path, capsys):
    path = tmp_path / "no" / "people.txt"
    assert main(["serve", "--new-token", "view", "vera", "--tokens", str(path)]) == BAD_INPUT
    assert "the token cannot be written: No such file or directory" in capsys.readouterr().err
