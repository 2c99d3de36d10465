"""The encrypted line on which an agent is asked to act: each side knows the certificate of the other, and no other."""

from __future__ import annotations

import hashlib
import ssl
from collections.abc import Mapping
from pathlib import Path

from roslens.model.errors import UsageError


def monitor_context(own: Path, agents: Mapping[str, str]) -> ssl.SSLContext:
    """Return how a monitor accepts.

    Args:
        own: file with its key and certificate.
        agents: certificates of agents (PEM) by their host.

    Raises:
        UsageError: a file is not what it should be.
    """
    context = _context(ssl.PROTOCOL_TLS_SERVER, own)
    for host, certificate in agents.items():
        _trust(context, certificate, f"the certificate of {host}")
    return context


def agent_context(own: Path, monitor: str) -> ssl.SSLContext:
    """Return how an agent connects; ``monitor`` is the monitor's certificate (PEM).

    Raises:
        UsageError: a file is not what it should be.
    """
    context = _context(ssl.PROTOCOL_TLS_CLIENT, own)
    _trust(context, monitor, "the monitor's certificate")
    return context


def fingerprint(certificate: str) -> str:
    """Return the SHA-256 of a certificate (PEM), in hexadecimal.

    Raises:
        UsageError: it is none.
    """
    try:
        return hashlib.sha256(ssl.PEM_cert_to_DER_cert(certificate.strip())).hexdigest()
    except ValueError as error:
        raise UsageError(f"no certificate: {error}", expected="what `roslens agent --enrol` wrote") from None


def peer_fingerprint(line: ssl.SSLSocket) -> str:
    """Return the SHA-256 of the certificate that the other side has proven to have; empty for none."""
    shown = line.getpeercert(binary_form=True)
    return hashlib.sha256(shown).hexdigest() if shown else ""


def _context(protocol: int, own: Path) -> ssl.SSLContext:
    context = ssl.SSLContext(protocol)
    context.minimum_version = ssl.TLSVersion.TLSv1_3
    context.check_hostname = False  # the certificate itself is known, whatever name it bears
    context.verify_mode = ssl.CERT_REQUIRED
    try:
        context.load_cert_chain(own)
    except (OSError, ssl.SSLError) as error:
        reason = getattr(error, "strerror", None) or error
        raise UsageError(
            f"no key and certificate: {reason}", where=str(own), expected="what `roslens agent --enrol` wrote"
        ) from None
    return context


def _trust(context: ssl.SSLContext, certificate: str, whose: str) -> None:
    try:
        context.load_verify_locations(cadata=certificate)
    except (ssl.SSLError, ValueError) as error:
        raise UsageError(f"{whose} is none: {error}", expected="what `roslens agent --enrol` wrote") from None
