"""What an agent and its monitor need to know of each other before one acts for the other: made in one step, kept apart.

Below a folder, ``monitor`` is for the host of the monitor, and a folder of the host's name for that host::

    monitor/monitor.pem           key and certificate of the monitor
    monitor/hosts/HOST.crt        certificate of the agent
    monitor/hosts/HOST.key        command key of that host
    HOST/agent.pem                key and certificate of the agent
    HOST/monitor.crt              certificate of the monitor
    HOST/command.key              command key of the host
    HOST/allow.yaml               what may be done there: an example of which nothing is on
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from pathlib import Path

import msgspec

from roslens.intake.bounded_file import read_bounded
from roslens.intake.generated_secret import Secret, new_secret
from roslens.live.agent.allow_list import EXAMPLE
from roslens.live.agent.key_file import read_key
from roslens.live.agent.pinned_tls import fingerprint
from roslens.model.errors import UsageError

_DAYS = 3650
_HOST = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]{0,62}\Z")
_LARGEST = 100_000
_OPENSSL_S = 30.0
_ENROL = "Enrol the host anew with `roslens agent --enrol`, which makes one"


class AgentEnrolment(msgspec.Struct, frozen=True):
    """What an agent has: file of key and certificate, the monitor's certificate, its command key, its allow-list."""

    own: Path
    monitor: str
    key: bytes
    allow: Path


class MonitorEnrolment(msgspec.Struct, frozen=True):
    """What a monitor has: its file of key and certificate, and of each host the certificate and the command key."""

    own: Path
    certificates: dict[str, str]
    keys: dict[str, bytes]


def enrol(folder: Path, host: str) -> Path:
    """Write what the agent of a host and its monitor need; return the folder for the host.

    Raises:
        UsageError: the host has no usable name or is enrolled already, or there is no openssl.
        OSError: something cannot be written.
    """
    if not _HOST.match(host) or host == "monitor":
        raise UsageError(
            f"the host {host[:80]!r}", expected="letters, digits, dots and dashes", advice="Take --name NAME"
        )
    theirs, ours = folder / host, folder / "monitor"
    if theirs.exists() or (ours / "hosts" / f"{host}.crt").exists():
        raise UsageError(
            f"{host} is enrolled there already",
            where=str(folder),
            advice=f"Remove {theirs} and {ours}/hosts/{host}.* first",
        )
    for one in (ours, ours / "hosts", theirs):
        one.mkdir(parents=True, mode=0o700, exist_ok=True)
    if not (ours / "monitor.pem").exists():
        _certificate("roslens monitor", ours / "monitor.pem")
    _certificate(f"roslens agent {host}", theirs / "agent.pem")
    _write(theirs / "monitor.crt", _certificate_in(ours / "monitor.pem"))
    _write(ours / "hosts" / f"{host}.crt", _certificate_in(theirs / "agent.pem"))
    key = new_secret(Secret.KEY) + "\n"
    _write(theirs / "command.key", key)
    _write(ours / "hosts" / f"{host}.key", key)
    _write(
        theirs / "allow.yaml", "".join(f"# {line}\n" if line else "\n" for line in EXAMPLE.splitlines()) + "nodes: []\n"
    )
    return theirs


def read_agent(folder: Path) -> AgentEnrolment:
    """Read what an agent has.

    Raises:
        UsageError: something is missing, is not what it should be, or others can read it.
    """
    _refuse_open(folder / "agent.pem")
    certificate = _text(folder / "monitor.crt")
    fingerprint(certificate)
    return AgentEnrolment(
        folder / "agent.pem", certificate, read_key(folder / "command.key", _ENROL), folder / "allow.yaml"
    )


def read_monitor(folder: Path) -> MonitorEnrolment:
    """Read what a monitor has.

    Raises:
        UsageError: something is missing, is not what it should be, or others can read it.
    """
    _refuse_open(folder / "monitor.pem")
    certificates = {one.stem: _text(one) for one in sorted((folder / "hosts").glob("*.crt"))}
    if not certificates:
        raise UsageError(
            "no host is enrolled", where=str(folder), expected="the folder `monitor` that `roslens agent --enrol` wrote"
        )
    for certificate in certificates.values():
        fingerprint(certificate)
    keys = {host: read_key(folder / "hosts" / f"{host}.key", _ENROL) for host in certificates}
    return MonitorEnrolment(folder / "monitor.pem", certificates, keys)


def _certificate(name: str, target: Path) -> None:
    """Write a key and a certificate for it that it signed itself, on the curve P-256."""
    openssl = shutil.which("openssl")
    if openssl is None:
        raise UsageError(
            "there is no openssl here", expected="the program, which makes the certificates",
            advice="Install the package openssl, or enrol on another host and copy the folders",
        )  # fmt: skip
    words = [
        openssl, "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes", "-sha256",
        "-days", str(_DAYS), "-subj", f"/CN={name}", "-keyout", "-", "-out", "-",
    ]  # fmt: skip
    try:
        made = subprocess.run(
            words, capture_output=True, timeout=_OPENSSL_S, check=False, stdin=subprocess.DEVNULL, cwd=os.sep
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise UsageError(f"openssl does not make a certificate: {error}") from None
    text = made.stdout.decode("ascii", "replace")
    if made.returncode or "BEGIN CERTIFICATE" not in text or "PRIVATE KEY" not in text:
        last = made.stderr.decode("utf-8", "replace").strip().rpartition("\n")[2]
        raise UsageError(f"openssl does not make a certificate: {last[:200]}")
    _write(target, text)


def _certificate_in(path: Path) -> str:
    text = _text(path)
    return text[text.index("-----BEGIN CERTIFICATE-----") :]


def _write(path: Path, text: str) -> None:
    with os.fdopen(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w", encoding="ascii") as stream:
        stream.write(text)


def _text(path: Path) -> str:
    try:
        return read_bounded(path, _LARGEST).decode("ascii", "replace")
    except OSError as error:
        raise UsageError(
            f"cannot read it: {error.strerror or error}", where=str(path), expected="what `roslens agent --enrol` wrote"
        ) from None


def _refuse_open(path: Path) -> None:
    _text(path)
    if path.stat().st_mode & 0o077:
        raise UsageError(
            "others can read the key", where=str(path), expected="a file for you alone", advice=f"chmod 600 {path}"
        )
