"""What a launch file starts and sets, in one form for both generations and all formats; nothing in it was executed.

Names, values and paths are texts that may have holes. What depends on a condition that cannot be evaluated is kept with
the condition, and a condition that is known to be false leaves it out.
"""

from __future__ import annotations

from enum import Enum

import msgspec

from roslens.model.configuration import Missing, Standing
from roslens.source.extract.facts.node_facts import EndpointFact, Evidence
from roslens.source.extract.symbolic.text import Conditions, Text


class Setting(msgspec.Struct, frozen=True, omit_defaults=True):
    """A parameter that is set.

    Attributes:
        name: as written; of ROS 1 resolved against the element it stands in (``/a/b``, or ``~b`` within a node).
        value: as text; lists and maps as YAML in one line.
        evidence: where it is set: in the launch file, or in the file of parameters.
        type: ``bool``, ``int``, ``double``, ``string``, ``list``, ``map`` or empty where unknown.
        node: pattern of nodes that a file of parameters is keyed to (``/**``, ``/ns/name``); empty where it stands for
            the node it is given to.
        words: the command line whose output the value is; empty where it is another one.
    """

    name: Text
    value: Text
    evidence: Evidence
    type: str = ""
    node: str = ""
    words: tuple[Text, ...] = ()


class Remap(msgspec.Struct, frozen=True, array_like=True):
    """A remapping: names from and to, as written."""

    source: Text
    target: Text
    evidence: Evidence


class Controller(msgspec.Struct, frozen=True):
    """A controller of ros_control that a spawner asks for.

    Attributes:
        name: of it with its namespace.
        kind: its type, as the parameter says.
        space: namespace of its manager.
        evidence: of the spawner.
        made: what the catalogue says that it makes; empty where that is known by code of the workspace alone.
        why: it is not known where nobody else knows.
        conditions: of the spawner.
    """

    name: Text
    kind: str
    space: Text
    evidence: Evidence
    made: tuple[EndpointFact, ...] = ()
    why: str = ""
    conditions: Conditions = ()


class Launched(msgspec.Struct, frozen=True, omit_defaults=True):
    """A node that is started, or a component or nodelet that is loaded.

    Attributes:
        package: that has it.
        executable: of the package (ROS 1: ``type``); empty of a component.
        evidence: where it is started.
        name: given to it; empty text where the program names itself.
        namespace: resolved as far as known, ``/`` at the top.
        plugin: class of a component or nodelet that is loaded (``ns::Class``, ``package/Class``).
        container: name of the container or nodelet manager it is loaded into.
        settings: parameters given to it, in order of growing precedence.
        remaps: of it, those of its scope first.
        arguments: on its command line, as far as known.
        conditions: that cannot be evaluated, as written, outermost first.
        kind: ``node``, ``lifecycle``, ``container``, ``component``, ``nodelet``, ``test`` or ``process``.
        machine: on which it runs; empty of this one.
        anonymous: whether its name gets a random end.
        plugged: what plug-ins make that are loaded into it (Gazebo).
        taken: remappings that plug-ins take for the namespace of their names.
        controllers: that it has loaded into a node which is not known yet (ros_control).
    """

    package: Text
    executable: Text
    evidence: Evidence
    name: Text = Text()
    namespace: Text = Text(("/",))
    plugin: Text = Text()
    container: Text = Text()
    settings: tuple[Setting, ...] = ()
    remaps: tuple[Remap, ...] = ()
    arguments: tuple[Text, ...] = ()
    conditions: Conditions = ()
    kind: str = "node"
    machine: str = ""
    anonymous: bool = False
    plugged: tuple[EndpointFact, ...] = ()
    taken: tuple[Remap, ...] = ()
    controllers: tuple[Controller, ...] = ()


class Argument(msgspec.Struct, frozen=True, omit_defaults=True):
    """An argument that a launch file declares; ``default`` None must be given."""

    name: str
    evidence: Evidence
    default: Text | None = None
    description: str = ""
    choices: tuple[str, ...] = ()


class Fault(str, Enum):
    """Why launch or roslaunch end with an error."""

    UNREADABLE = "a file that cannot be read"
    MISSING_FILE = "a file that is not there"
    CYCLE = "a file that includes itself"
    NOT_SET = "a launch configuration that nothing sets"
    EXPRESSION = "an expression or condition that fails"
    PARAMETERS = "a file of parameters that is refused"
    REFUSED = "an element that is refused"


class Unresolved(msgspec.Struct, frozen=True, array_like=True):
    """What could not be evaluated: as written, where, why, whether it may start further nodes, and what is missing.

    ``standing`` says whether it is certain to fail, and ``fault`` why then.
    """

    text: str
    evidence: Evidence
    reason: str
    opens: bool = False
    missing: Missing = Missing.OTHER
    standing: Standing = Standing.UNDECIDABLE
    fault: Fault | None = None


class Failed(msgspec.Struct, frozen=True, array_like=True):
    """Where launch or roslaunch end with an error.

    Attributes:
        fault: the kind of error.
        text: what fails, as written.
        evidence: where.
        reason: in words.
        open: whether it is reached under conditions only that are not known.
        through: places of the includes that lead there, outermost first.
    """

    fault: Fault
    text: str
    evidence: Evidence
    reason: str
    open: bool = False
    through: tuple[Evidence, ...] = ()


class ParameterFileUse(msgspec.Struct, frozen=True, array_like=True):
    """A file of parameters as a node is given it, unchanged: its path, and where it is given."""

    path: str
    evidence: Evidence


class Shared(msgspec.Struct, frozen=True, array_like=True):
    """An argument of an included file that gets the value which another included file left, not its default.

    Attributes:
        name: of the argument.
        evidence: where it is declared.
        default: that it is declared with.
        value: that it gets.
        left_by: where the other file declares the argument, or is given it.
        include: of the file that declares it.
    """

    name: str
    evidence: Evidence
    default: str
    value: str
    left_by: Evidence
    include: Evidence


class Launch(msgspec.Struct, frozen=True, omit_defaults=True):
    """What a launch file comes to with its arguments, all that it includes with it.

    Attributes:
        generation: ``ros1`` or ``ros2``.
        nodes: that it starts, in order.
        settings: parameters that it sets outside of nodes (ROS 1), with resolved names.
        arguments: that the file itself declares.
        included: files that it includes, directly or not, in order; each once.
        unresolved: what could not be evaluated.
        failed: where it ends with an error.
        raw_files: files of parameters that rcl reads as they are.
        shared: arguments of included files that get the value of another one (ROS 2).
        cut: whether a budget ended its evaluation, so that another time it may come to more.
    """

    generation: str
    nodes: tuple[Launched, ...] = ()
    settings: tuple[Setting, ...] = ()
    arguments: tuple[Argument, ...] = ()
    included: tuple[str, ...] = ()
    unresolved: tuple[Unresolved, ...] = ()
    failed: tuple[Failed, ...] = ()
    raw_files: tuple[ParameterFileUse, ...] = ()
    shared: tuple[Shared, ...] = ()
    cut: bool = False
