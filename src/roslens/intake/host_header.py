"""Whether the Host header of a request names this machine.

A page in a browser of the user could otherwise read what is served here through a name that it makes point here (DNS
rebinding). Numeric addresses cannot be rebound, so they pass.
"""

from __future__ import annotations

import ipaddress


def names_this_machine(given: str, names: frozenset[str]) -> bool:
    """Return whether a Host header, empty where there is none, is an address or one of the names, in lower case."""
    host = given.strip().lower()
    if host.startswith("["):
        host = host.partition("]")[0][1:]
    elif host.count(":") == 1:
        host = host.partition(":")[0]
    try:
        ipaddress.ip_address(host)
    except ValueError:
        return host.rstrip(".") in names
    return True
