"""Who is let in to pages that are served: options, and the address to open."""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.dashboard.access.audit import Entry
    from roslens.dashboard.access.person import Person
    from roslens.dashboard.access.policy import Access
    from roslens.dashboard.listener import Tls


class Door(msgspec.Struct, frozen=True):
    """How a server is entered.

    Attributes:
        access: its rules.
        tls: what it encrypts with.
        token: that was made for whoever reads the address on the terminal; empty where files give tokens, or none is
            needed.
    """

    access: Access
    tls: Tls | None = None
    token: str = ""

    def address(self, url: str) -> str:
        """Return the address to open: with the token that was made, if one was."""
        return f"{url}?token={self.token}" if self.token else url


def add_door_arguments(parser: argparse.ArgumentParser | argparse._ArgumentGroup) -> None:
    """Add who is let in, and how it is encrypted and written down."""
    parser.add_argument(
        "--tokens", type=Path, metavar="FILE",
        help="who may view and who may operate: a line `ROLE NAME TOKEN` each (default: on this machine everybody may "
        "view; elsewhere a token is made and printed)",
    )  # fmt: skip
    parser.add_argument(
        "--tls", type=Path, nargs=2, metavar=("CERTIFICATE", "KEY"), help="serve https with these files (PEM)"
    )
    parser.add_argument(
        "--audit", type=Path, metavar="FILE", help="append each sign-in, act and refusal of the pages, a line of JSON"
    )


def door_of(
    options: argparse.Namespace, host: str, *, acting: bool = False, wall: Callable[[], float] = time.time,
    report: Callable[[Entry], None] = lambda _: None,
) -> Door:  # fmt: skip
    """Return how a server that listens on ``host`` is entered.

    Args:
        options: of the command line.
        host: name or address that is listened on.
        acting: whether there is something that who may operate can do.
        wall: seconds since the epoch.
        report: called with each entry that the file of `--audit` gets.

    Raises:
        UsageError: the tokens, the certificate or its key are not what they should be.
    """
    from roslens.dashboard.access.audit import AuditFile, forgotten
    from roslens.dashboard.access.person import Person, Role
    from roslens.dashboard.access.policy import Access
    from roslens.dashboard.access.tokens import read_tokens
    from roslens.dashboard.listener import checked_tls, only_this_machine
    from roslens.intake.generated_secret import Secret, new_secret

    here = only_this_machine(host)
    holders: dict[str, Person] = {}
    token = ""
    if options.tokens is not None:
        holders = read_tokens(options.tokens)
    elif acting or not here:
        token = new_secret(Secret.TOKEN)
        holders = {token: Person("terminal", Role.OPERATE if acting else Role.VIEW)}
    if options.audit is not None and not options.audit.parent.is_dir():
        raise UsageError(f"no folder {options.audit.parent}", expected="a folder that is there", where="--audit")
    written = AuditFile(options.audit) if options.audit is not None else forgotten

    def audit(entry: Entry) -> None:
        report(entry)
        written(entry)

    access = Access(
        holders,
        view_needs_token=not here,
        audit=audit,
        wall=wall,
    )
    return Door(access, checked_tls(*options.tls) if options.tls else None, token)
