"""A configuration of a system, from source: its nodes as they would run, each fact with what shows it.

Names are resolved. A name of which a part cannot be known without running has ``*`` in its place, and ``resolved`` says
so.
"""

from __future__ import annotations

from enum import Enum

import msgspec

from roslens.model.graph import Endpoint, Graph, Node


class Origin(str, Enum):
    """What kind of source a fact has.

    - code: read from the source of the node
    - launch: a launch file, or a file of parameters that it names
    - catalogue: known of a node whose source is not in the workspace
    - hint: said by the user in ``roslens.toml``
    - implicit: every node of its kind has it
    """

    CODE = "code"
    LAUNCH = "launch"
    CATALOGUE = "catalogue"
    HINT = "hint"
    IMPLICIT = "implicit"


NAME_IS_GUESSED = "named after its executable, as its name in the code is unknown"
"""How a node has its name of which neither a launch file nor code tells it."""


class Proof(msgspec.Struct, frozen=True, order=True, omit_defaults=True):
    """Where a fact comes from, how it was resolved and how sure it is.

    Attributes:
        path: file below the root of the workspace; of a catalogue the place where its source can be read.
        line: in it; 0 where the whole file is meant.
        column: in bytes.
        how: in words.
        sure: ``certain``, ``likely`` (a default that may be set otherwise) or ``possible`` (a guess).
        origin: what kind of source it is.
    """

    path: str = ""
    line: int = 0
    column: int = 0
    how: str = ""
    sure: str = "certain"
    origin: Origin = Origin.CODE

    @property
    def place(self) -> str:
        """Return ``path:line``, as far as it is known."""
        return f"{self.path}:{self.line}" if self.line else self.path


class Clause(msgspec.Struct, frozen=True, order=True, omit_defaults=True):
    """One of several conditions that hold together: what has to hold, or must not."""

    text: str
    holds: bool = True


class ConfiguredEndpoint(msgspec.Struct, frozen=True, omit_defaults=True):
    """An endpoint as it would be.

    Attributes:
        endpoint: with resolved names.
        proof: where it is made.
        given: its name as the code gives it, unknown parts as ``{reason}``.
        resolved: whether all of its name is known.
        conditions: what must hold for it to be made, as written, outermost first.
        remapped: the remapping that changed its name.
        qos_unknown: reason why a part of the quality of service is unknown.
        queue: size of the queue in ROS 1; -1 where unknown.
        latched: whether it keeps the last message (ROS 1).
        callback: what is called.
        group: callback group.
        sites: where it publishes or calls.
        through: calls in helper functions and classes that pass its name on, the one that makes it last.
        by_parameter: whether a parameter that is set has a say in its name.
        clauses: its conditions, each with whether it is denied.
    """

    endpoint: Endpoint
    proof: Proof
    given: str = ""
    resolved: bool = True
    conditions: tuple[str, ...] = ()
    remapped: Proof | None = None
    qos_unknown: str = ""
    queue: int = -1
    latched: bool = False
    callback: str = ""
    group: str = ""
    sites: tuple[Proof, ...] = ()
    through: tuple[Proof, ...] = ()
    by_parameter: bool = False
    clauses: tuple[Clause, ...] = ()

    @property
    def implicit(self) -> bool:
        """Whether every node of its kind has it."""
        return self.proof.origin is Origin.IMPLICIT


class ConfiguredParameter(msgspec.Struct, frozen=True, omit_defaults=True):
    """A parameter of a node: what declares or reads it, and what sets it.

    Attributes:
        name: ROS 2: as declared; ROS 1: resolved.
        value: as text that it would have; None where it is unknown.
        type: of the value, or as declared.
        default: as declared; None where there is none or it is unknown.
        range: as declared: ``least..greatest``; either may be missing, and ``>`` or ``<`` stands before one that is
            outside of it.
        access: ``declared``, ``read``, ``written``; empty where code does not know it.
        proof: where code declares or reads it.
        set_type: of the value that is set.
        set_by: where its value is set; None where the default holds.
        conditions: of the code that reaches it.
        description: as declared.
        written_by: where code gives it its value, as sure as the value is; None where no code does.
        set_value: that is set, where code gives it another one; None elsewhere.
        read_only: whether it cannot be set while the node runs.
        dynamic: whether it may be set to a value of any type.
        allowed: the values that it may have, as text; empty where these are not counted.
        constraints: what else its declaration asks, in words.
        uncertain: whether something that starts the node and is not known, as a file of parameters, may set it too.
        other_types: with which other places of the code declare or read it too; empty of one that is unknown.
    """

    name: str
    value: str | None = None
    type: str = ""
    default: str | None = None
    range: str = ""
    access: str = ""
    proof: Proof | None = None
    set_type: str = ""
    set_by: Proof | None = None
    conditions: tuple[str, ...] = ()
    description: str = ""
    written_by: Proof | None = None
    set_value: str | None = None
    read_only: bool = False
    dynamic: bool = False
    allowed: tuple[str, ...] = ()
    constraints: tuple[str, ...] = ()
    uncertain: bool = False
    other_types: tuple[str, ...] = ()

    @property
    def repeats_an_endpoint(self) -> bool:
        """Whether it only repeats an endpoint's quality of service: an override that is not set."""
        return self.name.startswith("qos_overrides.") and self.set_by is None and self.written_by is None


class ConfiguredRemap(msgspec.Struct, frozen=True, order=True, omit_defaults=True):
    """A remapping as written, and whether any name of the node matched it; ``uncertain`` where that cannot be known."""

    source: str
    target: str
    proof: Proof
    used: bool = False
    uncertain: bool = False


class ConfiguredTimer(msgspec.Struct, frozen=True, omit_defaults=True):
    """A timer; its period in seconds, None where unknown."""

    period_s: float | None
    proof: Proof
    callback: str = ""
    group: str = ""


class Missing(str, Enum):
    """The unknown part of something that could not be evaluated, where reports distinguish it."""

    OTHER = ""
    NODE_NAME = "node name"
    ENDPOINT_NAME = "endpoint name"
    NAMED_ALIKE = "named alike"
    """A call of a function of the workspace that is named as what makes an endpoint, and makes none."""


class Standing(str, Enum):
    """What is known of something that could not be evaluated.

    - undecidable: what it comes to depends on what is known only while it runs, or is not followed
    - outside: it is in a package or a file that is not in the workspace
    - failure: what starts it ends there with an error
    """

    UNDECIDABLE = "undecidable"
    OUTSIDE = "outside the workspace"
    FAILURE = "certain failure"


class Unresolved(msgspec.Struct, frozen=True, order=True, omit_defaults=True):
    """What could not be evaluated.

    Attributes:
        text: as written.
        proof: where.
        reason: in words.
        node: of which it is a part; empty where no node is meant.
        opens: whether it may start further nodes, so that the configuration is not whole.
        role: whose code it is in where that is not own code: ``vendored``, ``generated`` or ``test``.
        missing: what is not known.
        cause: in words what a name depends on.
        standing: whether it is undecidable, outside of the workspace, or certain to fail.
        outside: packages that would tell and are not in the workspace.
    """

    text: str
    proof: Proof
    reason: str
    node: str = ""
    opens: bool = False
    role: str = ""
    missing: Missing = Missing.OTHER
    cause: str = ""
    standing: Standing = Standing.UNDECIDABLE
    outside: tuple[str, ...] = ()


class ConfiguredNode(msgspec.Struct, frozen=True, omit_defaults=True):
    """A node as it would run.

    Attributes:
        name: resolved.
        proof: where it is started; of a node that no launch file starts, where it is defined.
        resolved: whether all of its name is known.
        package: that has it.
        executable: of the package; of a component the name of its class.
        kind: ``node``, ``lifecycle``, ``container``, ``component``, ``nodelet``, ``test`` or ``process``; of what no
            known program starts ``plugin``, ``script``, ``program`` or ``library``.
        defined: where its code is; None where it is unknown.
        unit: class or function that is the node.
        container: name of the node it is loaded into.
        machine: on which it runs; empty of this one.
        anonymous: whether its name gets a random end.
        conditions: of its start.
        endpoints: sorted by role and name.
        parameters: sorted by name.
        remaps: in the order in which they hold.
        timers: in source order.
        role: whose code it is where that is not own code: ``vendored``, ``generated`` or ``test``.
        linked: of a node of which no endpoint is known, where code is that is linked into it, makes endpoints and is
            started by nothing that is known.
        clauses: its conditions, each with whether it is denied.
    """

    name: str
    proof: Proof
    resolved: bool = True
    package: str = ""
    executable: str = ""
    kind: str = "node"
    defined: Proof | None = None
    unit: str = ""
    container: str = ""
    machine: str = ""
    anonymous: bool = False
    conditions: tuple[str, ...] = ()
    endpoints: tuple[ConfiguredEndpoint, ...] = ()
    parameters: tuple[ConfiguredParameter, ...] = ()
    remaps: tuple[ConfiguredRemap, ...] = ()
    timers: tuple[ConfiguredTimer, ...] = ()
    role: str = ""
    linked: tuple[Proof, ...] = ()
    clauses: tuple[Clause, ...] = ()

    @property
    def name_is_guessed(self) -> bool:
        """Whether only its code names it, which is unknown: its executable stands for its name."""
        return self.defined is None and self.proof.sure != "certain"


class ConfiguredArgument(msgspec.Struct, frozen=True, omit_defaults=True):
    """An argument of a launch file; ``default`` None must be given."""

    name: str
    proof: Proof
    default: str | None = None
    description: str = ""
    choices: tuple[str, ...] = ()


class Configuration(msgspec.Struct, frozen=True, omit_defaults=True):
    """What would run together.

    Attributes:
        title: the launch file with its arguments, or the packages.
        generation: ``ros1`` or ``ros2``.
        nodes: sorted by name.
        parameters: set outside of nodes (ROS 1), sorted by name.
        arguments: that the launch file declares.
        included: files that the launch file includes, directly or not.
        unresolved: what could not be evaluated.
        version: of this form.
        unstarted: whether its nodes stand for code that makes endpoints and that no known program starts: a library, a
            plug-in, a script. In what nodes its endpoints are is not known, so their names are likely at most.
    """

    title: str
    generation: str
    nodes: tuple[ConfiguredNode, ...] = ()
    parameters: tuple[ConfiguredParameter, ...] = ()
    arguments: tuple[ConfiguredArgument, ...] = ()
    included: tuple[str, ...] = ()
    unresolved: tuple[Unresolved, ...] = ()
    version: int = 1
    unstarted: bool = False

    def graph(self, *, implicit: bool = True) -> Graph:
        """Return the computation graph, as a live system would show it: nodelets are part of their manager.

        The program that asks a manager to load one is a node of the nodelet's name.

        Args:
            implicit: whether endpoints that every node has are part of it.
        """
        names = {node.name for node in self.nodes}
        loading = {
            node.name for node in self.nodes if node.kind == "nodelet" and any(one.implicit for one in node.endpoints)
        }
        inside = {
            node.name: node.container
            for node in self.nodes
            if node.kind == "nodelet" and node.container in names and node.container != node.name
        }
        endpoints = {
            msgspec.structs.replace(one.endpoint, node=node.name if one.implicit else inside.get(node.name, node.name))
            for node in self.nodes
            for one in node.endpoints
            if implicit or not one.implicit
        }
        parameters: dict[str, dict[str, str]] = {}
        for node in self.nodes:
            # A process and a nodelet that it loads may have one name.
            parameters.setdefault(node.name, {}).update(
                (one.name, one.value) for one in node.parameters if one.value is not None
            )
        return Graph(
            self.generation,
            tuple(sorted({Node(name) for name in names if name not in inside or name in loading})),
            tuple(sorted(endpoints, key=_order)),
            parameters={
                name: values for name, values in parameters.items() if values and name not in inside.keys() - loading
            },
        )


def _order(endpoint: Endpoint) -> tuple[str, str, str, str]:
    return endpoint.node, endpoint.role.value, endpoint.name, endpoint.type
