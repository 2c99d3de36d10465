"""What source says of nodes: the facts from which a configuration is assembled, each with its evidence.

Names are as the code gives them, not yet resolved: ``scan``, ``/scan``, ``~/scan`` (private to the node). What a
``NodeHandle`` or sub-node puts in front is part of them.
"""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum

import msgspec

from roslens.model.graph import Role
from roslens.model.qos import Qos
from roslens.source.extract.symbolic.text import Condition, Conditions, Text


class Sure(str, Enum):
    """How sure a fact is.

    - certain: written there, or computed from constants
    - likely: a default that may be set otherwise, or one of several classes that may be meant
    - possible: bounded evaluation gave up, and this is the best guess
    """

    CERTAIN = "certain"
    LIKELY = "likely"
    POSSIBLE = "possible"


class Inherits(str, Enum):
    """What a node that code makes takes of what the component is loaded with that makes it."""

    NOTHING = ""
    ARGUMENTS = "arguments"
    PARAMETERS = "parameters"
    ALL = "all"


class Evidence(msgspec.Struct, frozen=True, array_like=True, order=True):
    """Where a fact comes from: a place in a file of the workspace, and in words how it was resolved."""

    path: str
    line: int
    column: int = 0
    how: str = "written"
    sure: Sure = Sure.CERTAIN


class Overrides(msgspec.Struct, frozen=True, array_like=True):
    """Policies of a quality of service that parameters may set (``qos_overrides./topic.publisher_id.depth``).

    Attributes:
        policies: by the names of their parameters: ``depth``, ``reliability`` …
        id: tells endpoints of one topic apart; empty where none is given.
        unknown: reason why policies or id are not all known; empty where they are.
        conditions: what must hold for them to be set by parameters at all, as written.
    """

    policies: tuple[str, ...]
    id: str = ""
    unknown: str = ""
    conditions: Conditions = ()


class EndpointFact(msgspec.Struct, frozen=True, omit_defaults=True):
    """An endpoint that a node makes.

    Attributes:
        role: what it does.
        name: of the topic, service or action, as given.
        type: ``package/Type`` (ROS 1) or ``package/msg/Type`` (ROS 2); a hole where unknown.
        evidence: where it is made.
        qos: of it; empty texts and zeros are unknown; None in ROS 1.
        qos_unknown: reason why a part of ``qos`` is unknown; empty where nothing is.
        overrides: which of its policies parameters may set; None where they may not.
        queue: size of the queue in ROS 1; -1 where unknown.
        latched: whether it keeps the last message for those who come late (ROS 1).
        callback: qualified name of what is called; empty where unknown.
        group: callback group, as a name in the source; empty of the default one.
        conditions: what must hold for it to be made, as written, outermost first.
        asked: those of them that parameters decide, and how.
        sites: where it publishes or calls.
        through: calls in helper functions and classes that pass the name on or are named as what makes an endpoint, the
            one that makes it last.
    """

    role: Role
    name: Text
    type: Text
    evidence: Evidence
    qos: Qos | None = None
    qos_unknown: str = ""
    queue: int = -1
    latched: bool = False
    callback: str = ""
    group: str = ""
    conditions: Conditions = ()
    sites: tuple[Evidence, ...] = ()
    through: tuple[Evidence, ...] = ()
    overrides: Overrides | None = None
    asked: tuple[tuple[Condition, Condition], ...] = ()


def led_to(fact: EndpointFact, site: Evidence) -> EndpointFact:
    """Return an endpoint that a call of a helper leads to."""
    places = {(one.path, one.line) for one in (fact.evidence, *fact.through)}
    if (site.path, site.line) in places:
        return fact
    return msgspec.structs.replace(fact, through=(site, *fact.through))


class Terms(msgspec.Struct, frozen=True, omit_defaults=True):
    """On what terms a parameter may be set, besides its type and range.

    Attributes:
        read_only: whether it cannot be set while the node runs.
        dynamic: whether it may be set to a value of any type.
        allowed: the values that it may have, as text; empty where these are not counted.
        constraints: what else is asked, in words.
    """

    read_only: bool = False
    dynamic: bool = False
    allowed: tuple[str, ...] = ()
    constraints: tuple[str, ...] = ()


class ParameterFact(msgspec.Struct, frozen=True, omit_defaults=True):
    """A parameter that a node declares, reads or writes.

    Attributes:
        name: as given.
        evidence: where.
        access: ``declared``, ``read`` or ``written``.
        type: ``bool``, ``int``, ``double``, ``string``, ``bool_array`` …; ``list`` of a list of unknown items; empty
            where unknown.
        default: as text; None where there is none, a hole where it is unknown.
        range: as ``least..greatest`` where the declaration gives one; either end may be missing, and
            ``>`` or ``<`` stands before one that is outside of it.
        conditions: what must hold for it to be reached.
        description: as declared.
        value: that code gives it; None where it gives none, a hole where it is unknown.
        writer: what gives it its value, as sure as that is; a server of dynamic_reconfigure gives the default, or what
            is set as far as it fits. None where nothing does.
        terms: on which it may be set.
    """

    name: Text
    evidence: Evidence
    access: str
    type: str = ""
    default: Text | None = None
    range: str = ""
    conditions: Conditions = ()
    description: str = ""
    value: Text | None = None
    writer: Evidence | None = None
    terms: Terms = Terms()


class TimerFact(msgspec.Struct, frozen=True, omit_defaults=True):
    """A timer: its period in seconds, None where unknown."""

    period_s: float | None
    evidence: Evidence
    callback: str = ""
    group: str = ""


class LoadFact(msgspec.Struct, frozen=True, omit_defaults=True):
    """A nodelet that code loads into its own process (``nodelet::Loader::load``).

    Attributes:
        name: of the nodelet.
        type: by which it is loaded, ``package/Class``.
        evidence: where.
        remaps: names from and to, for it alone.
        conditions: what must hold for it to be loaded.
    """

    name: Text
    type: Text
    evidence: Evidence
    remaps: tuple[tuple[Text, Text], ...] = ()
    conditions: Conditions = ()


class PluginFact(msgspec.Struct, frozen=True, omit_defaults=True):
    """A class that code loads by name into the node (pluginlib, class_loader).

    Attributes:
        type: name by which it is loaded.
        evidence: where.
        base: class that it implements, as written.
        made: qualified name of the class, joined by ``.``, where what it makes is among the facts; else empty.
    """

    type: Text
    evidence: Evidence
    base: str = ""
    made: str = ""


class NodeFacts(msgspec.Struct, frozen=True, omit_defaults=True):
    """Something that becomes a node when it is started: a program's main function, a component, a nodelet.

    Attributes:
        unit: qualified name of the class, or ``main`` or ``<module>`` of a file.
        path: file in which it is.
        line: of the class or function.
        generation: ``ros1`` or ``ros2``.
        kind: ``node``, ``lifecycle``, ``component``, ``nodelet``, ``plugin``, ``function`` that nothing
            calls, ``part`` of a function on a way that nothing took.
        name: that it gives itself; a hole where it does not.
        namespace: that it gives itself.
        endpoints: in source order.
        parameters: likewise.
        timers: likewise.
        arguments: of a command line that code gives it, besides that of its process.
        settings: parameters that code gives it, and their values.
        global_arguments: whether the command line of its process is for it too.
        inherits: what it takes of what is loaded that makes it.
        conditions: under which code makes it, as written, outermost first.
        number: counts the nodes that one evaluation makes; 0 is the first one.
        declares_set: whether it declares each parameter that is set for it.
        doubt: why its name and those of its endpoints may be others; empty where nothing is unknown of its options.
        uses: units whose facts are part of it (base classes, owned objects), for people.
        unresolved: what could not be evaluated, with the reason.
        loads: nodelets that it loads into its own process, in source order.
        plugins: classes that it loads by name, likewise.
        asks: texts of which it goes through the words: what they are decides what it makes.
    """

    unit: str
    path: str
    line: int
    generation: str
    kind: str = "node"
    name: Text = Text()
    namespace: Text = Text()
    endpoints: tuple[EndpointFact, ...] = ()
    parameters: tuple[ParameterFact, ...] = ()
    timers: tuple[TimerFact, ...] = ()
    arguments: tuple[Text, ...] = ()
    settings: tuple[tuple[Text, Text], ...] = ()
    global_arguments: bool = True
    inherits: Inherits = Inherits.NOTHING
    conditions: Conditions = ()
    number: int = 0
    uses: tuple[str, ...] = ()
    unresolved: tuple[tuple[Evidence, str], ...] = ()
    loads: tuple[LoadFact, ...] = ()
    declares_set: bool = False
    doubt: str = ""
    plugins: tuple[PluginFact, ...] = ()
    asks: tuple[Text, ...] = ()


def with_texts(facts: NodeFacts, change: Callable[[Text], Text]) -> NodeFacts:
    """Return facts with each of their texts changed."""
    return msgspec.structs.replace(
        facts,
        name=change(facts.name),
        namespace=change(facts.namespace),
        endpoints=tuple(
            msgspec.structs.replace(
                one,
                name=change(one.name),
                type=change(one.type),
                asked=tuple((condition, asked.changed(change)) for condition, asked in one.asked),
            )
            for one in facts.endpoints
        ),
        parameters=tuple(
            msgspec.structs.replace(
                one,
                name=change(one.name),
                default=None if one.default is None else change(one.default),
                value=None if one.value is None else change(one.value),
            )
            for one in facts.parameters
        ),
        arguments=tuple(change(one) for one in facts.arguments),
        settings=tuple((change(name), change(value)) for name, value in facts.settings),
        loads=tuple(
            msgspec.structs.replace(
                one,
                name=change(one.name),
                type=change(one.type),
                remaps=tuple((change(source), change(target)) for source, target in one.remaps),
            )
            for one in facts.loads
        ),
        asks=tuple(change(one) for one in facts.asks),
        plugins=tuple(msgspec.structs.replace(one, type=change(one.type)) for one in facts.plugins),
    )


class Generated(msgspec.Struct, frozen=True, array_like=True):
    """A file that declares parameters, of which a build makes code (generate_parameter_library).

    Attributes:
        target: name of the library or module that is made.
        path: of the file.
        python: whether a module of Python is made, else a header of C++.
    """

    target: str
    path: str
    python: bool = False


class TargetKind(str, Enum):
    """What a build makes."""

    EXECUTABLE = "executable"
    LIBRARY = "library"
    COMPONENT = "component"
    NODELET = "nodelet"
    PLUGIN = "plugin"
    SCRIPT = "script"


class Target(msgspec.Struct, frozen=True, omit_defaults=True):
    """What the build of a package makes and installs.

    Attributes:
        kind: what it is.
        package: that builds it.
        name: of the executable or library; of a component, nodelet or plug-in the name by which it is loaded.
        sources: files of the workspace it is made of, those of libraries of the same package that it links included.
        evidence: where the build says so.
        entry: class of a component, nodelet or plug-in (``ns::Class``); ``module:function`` of a Python entry point.
        library: in which a component, nodelet or plug-in lies; empty where unknown.
        installed: whether ``ros2 run`` or ``rosrun`` finds it.
        conditions: under which the build makes it, as written.
        versions: of ROS for which it is built, ``ros1`` and ``ros2``; empty where that is not known.
        elsewhere: whether it is installed, but not where ``ros2 run`` and launch files look.
    """

    kind: TargetKind
    package: str
    name: str
    sources: tuple[str, ...]
    evidence: Evidence
    entry: str = ""
    library: str = ""
    installed: bool = True
    conditions: tuple[str, ...] = ()
    versions: tuple[str, ...] = ()
    elsewhere: bool = False
