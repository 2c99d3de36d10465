import pytest

from roslens.cli.commands.agent import address_of
from roslens.cli.main import main
from roslens.model.errors import UsageError


@pytest.mark.parametrize(
    ("text", "address"),
    [
        ("base", ("base", 7411)),
        ("base.local:80", ("base.local", 80)),
        ("10.0.0.1:1", ("10.0.0.1", 1)),
        ("[::1]:90", ("::1", 90)),
        ("::1", ("::1", 7411)),
        ("[fe80::1]", ("fe80::1", 7411)),
    ],
)
def test_addresses(text, address):
    assert address_of(text) == address


@pytest.mark.parametrize("text", ["base:x", "base:70000", ":80", ""])
def test_no_addresses(text):
    with pytest.raises(UsageError, match="is no address"):
        address_of(text)


def test_a_key_is_made_once(tmp_path, capsys):
    path = tmp_path / "key"
    assert main(["agent", "--make-key", str(path)]) == 0
    assert main(["agent", "--make-key", str(path)]) == 2
    assert "there is a file already" in capsys.readouterr().err


def test_what_is_missing_is_said(tmp_path, capsys):
    assert main(["agent"]) == 2
    assert "no monitor; expected roslens agent HOST[:PORT] --key-file FILE" in capsys.readouterr().err
    assert main(["agent", "base"]) == 2
    assert "no key" in capsys.readouterr().err
    assert main(["agent", "base", "--key-file", str(tmp_path / "none")]) == 2
    assert "cannot read the key: No such file or directory" in capsys.readouterr().err
    assert main(["agent", "base", "--key-file", "x", "--period", "0"]) == 2
    assert "--period 0; expected seconds from 0.05 to 3600" in capsys.readouterr().err
