"""What can be done about a fault: the kinds of action that a reference may call for, and the arguments of each.

Documents are checked against :data:`ACTION_KINDS`, pages and the schema of references are made of it, and each kind
has a file of its name in ``live/act/actions``, or is carried out by the agent of the host (``by`` says who does it).
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum

import msgspec

from roslens.model.entity import EntityKind


class ArgumentType(str, Enum):
    """What the value of an argument is.

    A ``duration`` is written with its unit (``2 s``) and holds seconds once it was read. ``text`` may hold templates
    (``{entity}``), and so may every text inside of a ``mapping``, a ``list`` or ``anything``. A ``topic`` and a
    ``service`` are names that begin with ``/``; an ``interface`` is a type of message or service, ``package/Type`` or
    ``package/msg/Type``.
    """

    TEXT = "text"
    NUMBER = "number"
    WHOLE = "whole number"
    FLAG = "true or false"
    DURATION = "duration"
    CHOICE = "choice"
    NAMES = "list of texts"
    MAPPING = "mapping"
    ANYTHING = "anything"
    TOPIC = "topic"
    SERVICE = "service"
    INTERFACE = "interface"


class By(str, Enum):
    """Who carries an action out."""

    MONITOR = "the monitor"
    ROS = "the monitor, through ROS"
    HOST = "the host of the target, by its allow-list"


class Argument(msgspec.Struct, frozen=True):
    """One argument of an action.

    Attributes:
        name: as documents write it.
        type: of its value.
        text: what it means, for pages.
        required: whether there is no action without it.
        default: in the form that it has once it was read (durations in seconds); None where it is left out.
        choices: of a ``choice``, or of each text of a list; empty for any.
    """

    name: str
    type: ArgumentType
    text: str
    required: bool = False
    default: object = None
    choices: tuple[str, ...] = ()


class ActionKind(msgspec.Struct, frozen=True):
    """A kind of action.

    Attributes:
        key: under which documents call it.
        summary: one line, for pages and completion.
        by: who carries it out.
        targets: kinds of entities that it is done to; empty where it has no target.
        arguments: of the action.
        ros: generations of ROS that it exists for.
        touches: whether it changes anything on the robot; what only tells is not asked for, and nothing that touches
            has to wait for it.
        details: how it does it and where its limits are; paragraphs for its page.
    """

    key: str
    summary: str
    by: By
    targets: tuple[EntityKind, ...] = ()
    arguments: tuple[Argument, ...] = ()
    ros: tuple[int, ...] = (1, 2)
    details: str = ""
    touches: bool = True

    @property
    def needs_target(self) -> bool:
        """Whether it is done to an entity."""
        return bool(self.targets)

    def argument(self, name: str) -> Argument | None:
        """Return an argument by its name."""
        return next((one for one in self.arguments if one.name == name), None)

    def filled(self, given: Mapping[str, object]) -> dict[str, object]:
        """Return what is given, with the defaults of what is not."""
        defaults = {one.name: one.default for one in self.arguments if one.default is not None}
        return {**defaults, **given}


_T = ArgumentType
_NODE = (EntityKind.NODE,)
_TIMEOUT = Argument("timeout", _T.DURATION, "How long to wait for the response.", default=5.0)
_TEXT = Argument("text", _T.TEXT, "Text of the message; templates are filled in.", required=True)
_GRACE = Argument(
    "grace", _T.DURATION, "How long the process may take to exit after SIGINT; SIGTERM follows after half of it.",
    default=5.0,
)  # fmt: skip
_WHOLE = Argument(
    "whole_process", _T.FLAG, "Whether other nodes of the same process may be ended with it; if not, such a process is "
    "not touched.", default=False,
)  # fmt: skip
_AFTER_ORDERLY_END = Argument(
    "after_orderly_end", _T.FLAG, "Whether a node is also started again that was asked to end, or was done: its "
    "process ended with exit code 0, SIGINT, SIGTERM or SIGHUP.", default=False,
)  # fmt: skip
_LEVELS = ("info", "warning", "error")

ACTION_KINDS: tuple[ActionKind, ...] = (
    ActionKind(
        "notify",
        "Notify operators: in the log of ROS and as a diagnostic.",
        By.ROS,
        arguments=(
            _TEXT,
            Argument("level", _T.CHOICE, "Severity of the message.", default="warning", choices=_LEVELS),
            Argument(
                "to",
                _T.NAMES,
                "Where to publish it: `rosout` is /rosout, `diagnostics` a status on /diagnostics.",
                default=("rosout", "diagnostics"),
                choices=("rosout", "diagnostics"),
            ),
        ),
        details="Use Alertmanager for mail and paging: `roslens watch --prometheus` gives it the same verdicts.",
        touches=False,
    ),
    ActionKind(
        "webhook",
        "Post the event as JSON to a URL.",
        By.MONITOR,
        arguments=(
            Argument("url", _T.TEXT, "URL to post to: `http://` or `https://`.", required=True),
            Argument("text", _T.TEXT, "Text of the message; templates are filled in.", default=""),
            _TIMEOUT,
        ),
        details="The JSON has `text`, `reaction`, `entity`, `time` (seconds since the epoch) and `because`. "
        "Redirects are not followed. A status other than 2xx is a failure.",
        touches=False,
    ),
    ActionKind(
        "publish",
        "Publish a message, such as an emergency stop.",
        By.ROS,
        arguments=(
            Argument("topic", _T.TOPIC, "Topic to publish on.", required=True),
            Argument("type", _T.INTERFACE, "Type of the message.", required=True),
            Argument("fields", _T.MAPPING, "Values of its fields; others keep their default.", default={}),
            Argument(
                "how",
                _T.CHOICE,
                "`once`; `latched`: kept for subscribers that connect later; `repeated`: repeatedly until "
                "the cause is gone.",
                default="once",
                choices=("once", "latched", "repeated"),
            ),
            Argument("rate", _T.NUMBER, "Rate of `repeated`, in Hz, up to 100.", default=10.0),
        ),
        details="The publisher is created when reactions start, so that subscribers know it before it is needed. A "
        "field that the type does not have, or a value that does not fit, is rejected then, too.",
    ),
    ActionKind(
        "call",
        "Call a service.",
        By.ROS,
        arguments=(
            Argument("service", _T.SERVICE, "Name of the service.", required=True),
            Argument("type", _T.INTERFACE, "Type of the service.", required=True),
            Argument("fields", _T.MAPPING, "Values of the request; others keep their default.", default={}),
            _TIMEOUT,
        ),
        details="A response whose field `success` is false is a failure. A call without a response may have taken "
        "effect all the same: it is reported as failed.",
    ),
    ActionKind(
        "set_parameter",
        "Set a parameter of a node.",
        By.ROS,
        targets=_NODE,
        arguments=(
            Argument(
                "name",
                _T.TEXT,
                "Name of the parameter; in ROS 1 below the node's name unless it begins with `/`.",
                required=True,
            ),
            Argument(
                "value",
                _T.ANYTHING,
                "Its value: true or false, a number, a text, or a list of one of these.",
                required=True,
            ),
            _TIMEOUT,
        ),
        details="In ROS 2 the node may reject the value, which is a failure with its reason. In ROS 1 it is set in the "
        "parameter server, and has no effect on nodes that read it only at their start.",
    ),
    ActionKind(
        "lifecycle",
        "Change the state of a managed node.",
        By.ROS,
        targets=_NODE,
        arguments=(
            Argument(
                "transition",
                _T.CHOICE,
                "Transition to request.",
                required=True,
                choices=("configure", "activate", "deactivate", "cleanup", "shutdown"),
            ),
            _TIMEOUT,
        ),
        ros=(2,),
        details="A transition that is not available in the state of the node, or that the node fails, is a failure.",
    ),
    ActionKind(
        "unload",
        "Unload a component from its container.",
        By.ROS,
        targets=_NODE,
        arguments=(
            Argument("container", _T.TEXT, "Name of the container's node.", required=True),
            _TIMEOUT,
        ),
        ros=(2,),
        details="The component is looked up by name in the container.",
    ),
    ActionKind(
        "load",
        "Load a component into a container.",
        By.ROS,
        arguments=(
            Argument("container", _T.TEXT, "Name of the container's node.", required=True),
            Argument("package", _T.TEXT, "Package of the component.", required=True),
            Argument("plugin", _T.TEXT, "Its class: `demo_nodes_cpp::Talker`.", required=True),
            Argument("name", _T.TEXT, "Name of the node.", default=""),
            Argument("namespace", _T.TEXT, "Namespace of the node.", default=""),
            Argument("remap", _T.NAMES, "Remappings: `from:=to`.", default=()),
            Argument("parameters", _T.MAPPING, "Its parameters.", default={}),
            _TIMEOUT,
        ),
        ros=(2,),
        details="If the container already has a component of that name, nothing is loaded, and a failure is reported.",
    ),
    ActionKind(
        "stop",
        "Stop the process of a node.",
        By.HOST,
        targets=_NODE,
        arguments=(_GRACE, _WHOLE),
        details="The process is asked to exit and never killed: if it still runs after its grace, that is a failure. "
        "If a supervisor (a launch file's respawn, systemd) restarts it, this is reported and not prevented.",
    ),
    ActionKind(
        "restart",
        "Stop the process of a node, and start it again as it was.",
        By.HOST,
        targets=_NODE,
        arguments=(
            _GRACE,
            Argument(
                "kill_after",
                _T.DURATION,
                "How long after its grace a process that still runs is killed; 0: never.",
                default=5.0,
            ),
            _WHOLE,
            _AFTER_ORDERLY_END,
        ),
        details="Command line, environment, working directory, namespace and parameters are those that the agent "
        "recorded while the process ran. If a supervisor has already restarted the process, it is not started twice. "
        "What somebody else ended in order, such as an operator with Ctrl-C, stays ended.",
    ),
    ActionKind(
        "start",
        "Start a node that is gone, as it was.",
        By.HOST,
        targets=_NODE,
        arguments=(_AFTER_ORDERLY_END,),
        details="It is started as by `restart`. What somebody else ended in order, such as an operator with Ctrl-C, "
        "stays ended. A node that runs is not touched, which is reported as done.",
    ),
    ActionKind(
        "kill",
        "Kill the process of a node, after giving it the chance to exit.",
        By.HOST,
        targets=_NODE,
        arguments=(_GRACE, _WHOLE),
        details="SIGINT, SIGTERM after half of the grace, SIGKILL at its end. This also ends processes that are "
        "stopped or hung.",
    ),
    ActionKind(
        "command",
        "Run a command that the host has on its allow-list.",
        By.HOST,
        targets=(EntityKind.HOST, EntityKind.NODE),
        arguments=(Argument("name", _T.TEXT, "Its name in the allow-list.", required=True),),
        details="The command itself is defined in the allow-list only, as a list of arguments without a shell; no part "
        "of it is transmitted. For a node, it runs on the host of the node.",
    ),
    ActionKind(
        "record",
        "Record the recent and the next messages of some topics.",
        By.ROS,
        arguments=(
            Argument("topics", _T.NAMES, "Topics or patterns of them.", required=True),
            Argument("before", _T.DURATION, "Duration to keep from before the action.", default=10.0),
            Argument("after", _T.DURATION, "Duration to record after it.", default=10.0),
        ),
        details="One MCAP file per action, below the folder of the journal. Recent messages are held in "
        "memory, at most 64 MB; beyond that the oldest are dropped. The result states the length of the recording.",
        touches=False,
    ),
    ActionKind(
        "snapshot",
        "Store the current state for a post-mortem: graph, verdicts, values, processes, last log lines, /rosout.",
        By.MONITOR,
        details="One folder per action, below the folder of the journal, with JSON files, a text summary, and the "
        "messages on /rosout of the last 60 s as MCAP (`rosout-ros2.mcap`), held in memory, at most 64 MB.",
        touches=False,
    ),
)

_BY_KEY = {one.key: one for one in ACTION_KINDS}


def action_kind(key: str) -> ActionKind | None:
    """Return the kind that documents call by ``key``."""
    return _BY_KEY.get(key)
