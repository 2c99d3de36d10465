from base64 import urlsafe_b64decode

import pytest

from roslens.cli.main import main
from roslens.cli.watch.agent_address import address_of
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
    with pytest.raises(UsageError, match="is not an address"):
        address_of(text)


def test_a_key_is_made_once(tmp_path, capsys):
    path = tmp_path / "key"
    assert main(["agent", "--new-key", str(path)]) == 0
    assert main(["agent", "--new-key", str(path)]) == 2
    assert "there is a file already" in capsys.readouterr().err


def test_a_new_key_has_256_random_bits_and_is_for_its_user_alone(tmp_path):
    paths = [tmp_path / name for name in ("one", "other")]
    for path in paths:
        assert main(["agent", "--new-key", str(path)]) == 0
        assert path.stat().st_mode & 0o777 == 0o600
    one, other = (urlsafe_b64decode(path.read_text("ascii")[4:47] + "=") for path in paths)
    assert (len(one) * 8, len(other) * 8) == (256, 256)
    assert one != other


def test_a_word_is_refused_as_a_key_with_what_to_do(tmp_path, capsys):
    path = tmp_path / "key"
    path.write_text("our robots are the best robots of all\n")
    path.chmod(0o600)
    assert main(["agent", "base", "--key-file", str(path)]) == 2
    assert main(["watch", "--listen", "127.0.0.1:0", "--key-file", str(path)]) == 2
    said = capsys.readouterr().err
    assert said.count("expected a key that roslens generated, with 256 random bits") == 2
    assert said.count(f"`roslens agent --new-key {path}`") == 2


def test_what_is_missing_is_said(tmp_path, capsys):
    assert main(["agent"]) == 2
    assert "no monitor; expected roslens agent HOST[:PORT] --key-file FILE" in capsys.readouterr().err
    assert main(["agent", "base"]) == 2
    assert "no key" in capsys.readouterr().err
    assert main(["agent", "base", "--key-file", str(tmp_path / "none")]) == 2
    assert "cannot read the key: No such file or directory" in capsys.readouterr().err
    assert main(["agent", "base", "--key-file", "x", "--period", "0"]) == 2
    assert "--period 0; expected seconds from 0.05 to 3600" in capsys.readouterr().err
