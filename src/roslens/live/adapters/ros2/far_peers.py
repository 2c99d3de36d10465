"""Announces the observer to every process of ROS 2 on this machine, also where there are many.

Where discovery is limited to this machine, rmw_fastrtps announces a participant to the first 32 of a domain only: they
are known by their ports, and nobody multicasts. Participants beyond hear of those alone to whom they announce
themselves, so an observer beyond never meets a node beyond. A profile, for this process alone, names the other ports.

Ports are those of the RTPS specification: 7400 + 250 x domain + 10 + 2 x participant.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, MutableMapping
from contextlib import contextmanager
from pathlib import Path

from roslens.children.scratch_folder import ScratchFolder

KNOWN = 32
"""To how many rmw_fastrtps announces itself."""
MOST = 120
"""Participants of a domain before their ports run into those of the next one."""
_MIDDLEWARES = ("", "rmw_fastrtps_cpp", "rmw_fastrtps_dynamic_cpp")
_NEW, _OLD = "FASTDDS_DEFAULT_PROFILES_FILE", "FASTRTPS_DEFAULT_PROFILES_FILE"
_OLD_DISTRIBUTIONS = ("iron", "jazzy")
_OWN_FILE = "DEFAULT_FASTDDS_PROFILES.xml"
_PROFILE = """<?xml version="1.0" encoding="UTF-8"?>
<dds><profiles xmlns="http://www.eprosima.com">
<participant profile_name="roslens" is_default_profile="true"><rtps><builtin><initialPeersList>
{peers}
</initialPeersList></builtin></rtps></participant>
</profiles></dds>
"""
_PEER = "<locator><udpv4><address>127.0.0.1</address><port>{port}</port></udpv4></locator>"


def wanted(environment: Mapping[str, str], folder: Path) -> bool:
    """Whether participants are found by their ports alone, and no profile of the user overrides that.

    Args:
        environment: of the process that makes the participant.
        folder: in which it runs.
    """
    return (
        environment.get("ROS_AUTOMATIC_DISCOVERY_RANGE", "").upper() == "LOCALHOST"
        # Distributions before Iron do not know that variable.
        and environment.get("ROS_DISTRO", "") not in ("foxy", "galactic", "humble")
        and environment.get("RMW_IMPLEMENTATION", "") in _MIDDLEWARES
        and not any(environment.get(name) for name in (_NEW, _OLD))
        and not (folder / _OWN_FILE).exists()
    )


def profile(domain: int) -> str:
    """The text of a profile that announces a participant to those of a domain that it would not know."""
    begin = 7400 + 250 * domain + 10
    ports = (begin + 2 * number for number in range(KNOWN, MOST))
    return _PROFILE.format(peers="\n".join(_PEER.format(port=port) for port in ports if port < 1 << 16))


@contextmanager
def far_peers(environment: MutableMapping[str, str], domain: int | None) -> Iterator[None]:
    """While a participant is made: let it announce itself to all on this machine.

    Args:
        environment: of this process, which the middleware reads.
        domain: None for that of the environment.
    """
    if not wanted(environment, Path.cwd()):
        yield
        return
    number = environment.get("ROS_DOMAIN_ID", "") if domain is None else str(domain)
    variable = _OLD if environment.get("ROS_DISTRO", "") in _OLD_DISTRIBUTIONS else _NEW
    with ScratchFolder("peers") as folder:
        path = Path(folder) / "peers.xml"
        path.write_text(profile(int(number) if number.isdigit() else 0))
        environment[variable] = str(path)
        try:
            yield
        finally:
            environment.pop(variable, None)
