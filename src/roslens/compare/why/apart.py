"""Programs of ROS 2 that run on this host and cannot meet what was looked at: another domain, middleware or range."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from roslens.compare.why.observed import Observed
from roslens.model.answers.answer import Asks, Step, StepState
from roslens.model.answers.ros_process import RosProcess

_MOST = 6
_ZENOH = "rmw_zenoh_cpp"
FAST_DDS = ("", "rmw_fastrtps_cpp", "rmw_fastrtps_dynamic_cpp")
"""What chooses Fast DDS; it is the default where nothing is chosen."""
DOMAIN, RMW, DISCOVERY = "ROS_DOMAIN_ID", "RMW_IMPLEMENTATION", "ROS_AUTOMATIC_DISCOVERY_RANGE"


def differences(process: RosProcess, observed: Observed) -> list[str]:
    """Return in words why a process cannot meet what was looked at; empty where nothing is known to keep them apart."""
    found = []
    here = observed.here
    if (process.domain or "0") != (here.get(DOMAIN) or "0"):
        found.append(f"{DOMAIN} is {process.domain or '0 (not set)'}, looked at is {here.get(DOMAIN) or '0'}")
    if process.rmw and here.get(RMW) and process.rmw != here[RMW]:
        found.append(f"{RMW} is {process.rmw}, looked at is {here[RMW]}")
    if process.discovery == "OFF":
        found.append(f"{DISCOVERY} is OFF, so it meets nobody")
    if not found and _is_hidden(process, observed):
        found.append(f"it runs as user {process.user}, looked at was as user {observed.user}, and none of its nodes is "
                     "seen: Fast DDS may not write the memory of another user")  # fmt: skip
    return found


def _is_hidden(process: RosProcess, observed: Observed) -> bool:
    """Return whether no node of a process of another user is seen, where users share no memory."""
    is_other = observed.user is not None and process.user != observed.user
    return (
        is_other
        and process.rmw in FAST_DDS
        and process.pid not in {one.pid for one in observed.graph.nodes}
        and not observed.closed_memory.isdisjoint({process.user, observed.user})
    )


def reached(observed: Observed, programs: Mapping[str, str], asked: str) -> Step | None:
    """Return whether programs of ROS 2 run here that cannot be met; None of ROS 1, or where none could be looked into.

    Args:
        observed: the running system.
        programs: what the command line of a wanted node has in it, such as its executable, each with the node; where
            one of these runs apart, it is a cause, and any other program that does is told only.
        asked: the name that is asked about.
    """
    if observed.graph.generation == "ros1" or not (observed.processes or observed.unreadable):
        return None
    if (router := _router_missing(observed)) is not None and (programs or not observed.graph.nodes):
        return router
    apart = [(one, words) for one in observed.processes if (words := differences(one, observed))]
    wanted = [(one, words) for one, words in apart if _node(one, programs)]
    if wanted:
        one, words = wanted[0]
        says = f"{_node(one, programs)} runs apart from what was looked at: {words[0]}"
        how = "start both sides with the same value, or look there"
        is_domain = words[0].startswith(DOMAIN)
        other = f"roslens why {asked} --live --domain {one.domain or 0}" if is_domain else ""
        return Step(Asks.REACHED, StepState.NOT, says, "live", tuple(_lines(wanted)), how, other)
    if apart:
        says = f"{len(apart)} program{'s' * (len(apart) > 1)} of ROS 2 on this host cannot meet what was looked at"
        return Step(Asks.REACHED, StepState.UNSEEN, says, "live", tuple(_lines(apart)),
                    "if one of them should make it, start both sides with the same value")  # fmt: skip
    if observed.unreadable and not observed.processes:
        says = f"{observed.unreadable} processes of other users cannot be looked into"
        return Step(Asks.REACHED, StepState.UNSEEN, says, "live", how="run it as the user of the robot, or as root")
    return Step(Asks.REACHED, StepState.OK, "all programs of ROS 2 on this host have the same domain and middleware",
                "live")  # fmt: skip


def _router_missing(observed: Observed) -> Step | None:
    """Return that nodes on Zenoh have no router on this host, without which they do not find each other."""
    on_zenoh = [one for one in observed.processes if one.rmw == _ZENOH]
    if not on_zenoh or observed.routers or observed.here.get(RMW) != _ZENOH:
        return None
    count = "1 program" if len(on_zenoh) == 1 else f"{len(on_zenoh)} programs"
    says = f"no router of Zenoh runs here, and {count} of ROS 2 on Zenoh {'does' if len(on_zenoh) == 1 else 'do'}"
    lines = tuple(f"{one.command} (process {one.pid}): RMW_IMPLEMENTATION is {one.rmw}" for one in on_zenoh[:_MOST])
    how = "start the router, unless the configuration of Zenoh names one on another host"
    return Step(Asks.REACHED, StepState.NOT, says, "live", lines, how, "ros2 run rmw_zenoh_cpp rmw_zenohd")


def _node(process: RosProcess, programs: Mapping[str, str]) -> str:
    """Return the wanted node that a process is by its command line; empty where it is none of them."""
    return next((node for word, node in programs.items() if word in process.command), "")


def _lines(apart: Sequence[tuple[RosProcess, list[str]]]) -> Iterator[str]:
    for one, words in apart[:_MOST]:
        yield f"{one.command} (process {one.pid}): {'; '.join(words)}"
