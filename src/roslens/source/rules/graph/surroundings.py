"""What the rules of the graph know besides the configuration: the workspace around it, and what users set."""

from __future__ import annotations

import msgspec

from roslens.model.configuration import Clause, Proof
from roslens.model.source import Package

COMMAND_TOPICS = (
    "*/cmd_vel", "*/cmd_vel_unstamped", "*/cmd_vel_stamped", "*/ackermann_cmd", "*/joint_command", "*/joint_commands",
    "*/joint_trajectory", "*_controller/command", "*_controller/commands",
)  # fmt: skip
"""Topics whose messages move something: one source at a time is meant."""

EXTERNAL = (
    "/clock", "/tf", "/tf_static", "/rosout", "/rosout_agg", "/parameter_events", "/diagnostics", "*/diagnostics",
    "/diagnostics_agg", "/diagnostics_toplevel_state", "/initialpose", "/goal_pose", "/clicked_point",
    "/move_base_simple/goal", "*/parameter_descriptions", "*/parameter_updates", "*/set_parameters",
    "*/transition_event", "*/compressed", "*/compressedDepth", "*/theora", "*/zstd", "*/ffmpeg", "*/feedback",
    "*/bond", "/statistics",
)  # fmt: skip
"""Names whose other end is usually outside of what is launched: of tools, of people, of every node."""

FAST_HZ = 20.0
"""Messages a second from which on a topic is a fast one."""


class Ignored(msgspec.Struct, frozen=True, omit_defaults=True):
    """A file of parameters that is given to a node and has none for it.

    Attributes:
        node: resolved name of the node.
        proof: the file, at its first key.
        keys: the names of nodes that the file has parameters for.
        given: where the node gets the file.
        also: other nodes that get it there and have no parameters in it either.
    """

    node: str
    proof: Proof
    keys: tuple[str, ...]
    given: Proof
    also: tuple[str, ...] = ()


class Transform(msgspec.Struct, frozen=True, omit_defaults=True):
    """A transform that a node publishes all the time, as its command line says."""

    node: str
    parent: str
    child: str
    proof: Proof
    conditions: tuple[str, ...] = ()
    clauses: tuple[Clause, ...] = ()


class Wait(msgspec.Struct, frozen=True, omit_defaults=True):
    """A place that waits for the answer of a service.

    Attributes:
        function: qualified name of the function that waits.
        proof: the call, the same place as a site of the client.
        how: in words, ``call()`` …
    """

    function: str
    proof: Proof
    how: str = "call()"


class Commanded(msgspec.Struct, frozen=True, omit_defaults=True):
    """A controller that takes commands on a topic below its name.

    Attributes:
        name: of it.
        type: by which its manager loads it.
        topic: the last part of the topic.
        proof: where a file of parameters gives it its type.
    """

    name: str
    type: str
    topic: str
    proof: Proof


class Surroundings(msgspec.Struct, frozen=True, omit_defaults=True):
    """Everything that a rule may know besides the configuration.

    Attributes:
        packages: of the workspace.
        installed: by package of the workspace what its build installs, by the names by which it is started or loaded;
            a package whose build is not known in full is left out.
        unbuilt: by package of those the sources of C++ that no target is made of, as paths.
        given: arguments of the launch file, by name.
        started: whether somebody says with which arguments the launch file is started: `roslens.toml`, or a command
            line; else it may be meant to be included.
        whole: whether `roslens.toml` says that all of the system is in the configuration.
        ignored: files of parameters that are not for the node they are given to.
        transforms: that are published all the time.
        waits: places that wait for the answer of a service.
        controllers: that take stamped commands, of all parameter files of the workspace.
        mentioned: last parts of names, of those that one node alone uses, that other files of the workspace hold.
        command_topics: patterns of topics that move something.
        external: patterns of names whose other end is elsewhere.
        fast_hz: from which on a topic is a fast one.
        together: whether a launch file says that the nodes run together, and under these names; what packages make
            without one does not have to.
    """

    packages: tuple[Package, ...] = ()
    installed: dict[str, tuple[str, ...]] = {}
    unbuilt: dict[str, tuple[str, ...]] = {}
    given: dict[str, str] = {}
    ignored: tuple[Ignored, ...] = ()
    transforms: tuple[Transform, ...] = ()
    waits: tuple[Wait, ...] = ()
    mentioned: frozenset[str] = frozenset()
    controllers: tuple[Commanded, ...] = ()
    command_topics: tuple[str, ...] = COMMAND_TOPICS
    external: tuple[str, ...] = EXTERNAL
    fast_hz: float = FAST_HZ
    together: bool = True
    started: bool = False
    whole: bool = False

    def is_external(self, name: str) -> bool:
        """Return whether the other end of a name is usually elsewhere."""
        return _matches(name, self.external)

    def is_command(self, name: str) -> bool:
        """Return whether messages of a topic move something."""
        return _matches(name, self.command_topics)


def _matches(name: str, patterns: tuple[str, ...]) -> bool:
    from fnmatch import fnmatchcase

    return any(fnmatchcase(name, pattern) for pattern in patterns)
