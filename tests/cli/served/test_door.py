"""Who is let in, by the address that is listened on and the options."""

from __future__ import annotations

import argparse
import ssl
import subprocess
from pathlib import Path

import pytest

from roslens.cli.page.door import add_door_arguments, door_of
from roslens.dashboard.access.person import Role
from roslens.dashboard.listener import checked_tls, only_this_machine
from roslens.intake.generated_secret import Secret, new_secret
from roslens.model.errors import UsageError

MADE = new_secret(Secret.TOKEN)


def options(*given: str) -> argparse.Namespace:
    parser = argparse.ArgumentParser()
    add_door_arguments(parser)
    return parser.parse_args(given)


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "::1", "127.9.9.9"])
def test_on_this_machine_everybody_views(host: str) -> None:
    door = door_of(options(), host)
    assert door.token == ""
    assert not door.access.view_needs_token
    assert not door.access.tokens
    assert door.address("http://127.0.0.1:1/") == "http://127.0.0.1:1/"


@pytest.mark.parametrize("host", ["0.0.0.0", "::", "192.0.2.1", "no.such.host.invalid"])
def test_elsewhere_a_token_is_made_and_printed(host: str) -> None:
    door = door_of(options(), host)
    assert door.access.view_needs_token
    person = door.access.tokens.holder(door.token)
    assert person is not None
    assert person.role is Role.VIEW
    assert door.address("http://h:1/") == f"http://h:1/?token={door.token}"


def test_where_something_acts_the_terminal_may_operate() -> None:
    door = door_of(options(), "127.0.0.1", acting=True)
    person = door.access.tokens.holder(door.token)
    assert person is not None
    assert person.may_operate
    assert not door.access.view_needs_token


def test_a_file_of_tokens_takes_the_place_of_one_that_is_made(tmp_path: Path) -> None:
    path = tmp_path / "tokens"
    path.write_text(f"view vera {MADE}\n")
    path.chmod(0o600)
    door = door_of(options("--tokens", str(path)), "0.0.0.0", acting=True)
    assert door.token == ""
    assert door.access.view_needs_token
    found = door.access.tokens.holder(MADE)
    assert found is not None
    assert found.name == "vera"


def test_records_want_a_folder_that_is_there(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="no folder"):
        door_of(options("--audit", str(tmp_path / "no" / "audit.jsonl")), "127.0.0.1")


def test_an_unknown_name_is_not_only_this_machine() -> None:
    assert only_this_machine("localhost")
    assert not only_this_machine("no.such.host.invalid")


def test_what_to_encrypt_with_is_looked_at_before_anybody_comes(tmp_path: Path) -> None:
    key, certificate = tmp_path / "key.pem", tmp_path / "certificate.pem"
    subprocess.run(
        ["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes", "-days", "2",
         "-subj", "/CN=localhost", "-keyout", key, "-out", certificate],
        check=True, capture_output=True,
    )  # fmt: skip
    found = checked_tls(certificate, key)
    ssl.create_default_context(ssl.Purpose.CLIENT_AUTH).load_cert_chain(found.certificate, found.key)
    assert door_of(options("--tls", str(certificate), str(key)), "127.0.0.1").tls == found
    with pytest.raises(UsageError, match="both in PEM"):
        checked_tls(key, key)
    with pytest.raises(UsageError, match="No such file"):
        checked_tls(tmp_path / "nowhere", key)
