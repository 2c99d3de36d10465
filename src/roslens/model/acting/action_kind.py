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
        summary: one sentence, for pages and completion.
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
_TIMEOUT = Argument("timeout", _T.DURATION, "How long is waited for the answer.", default=5.0)
_TEXT = Argument("text", _T.TEXT, "What is said; templates are filled in.", required=True)
_GRACE = Argument(
    "grace", _T.DURATION, "How long the process may take to end by itself after it was asked (SIGINT, half of it later "
    "SIGTERM).", default=5.0,
)  # fmt: skip
_WHOLE = Argument(
    "whole_process", _T.FLAG, "Whether other nodes of the same process may end with it; without, such a process is "
    "left alone.", default=False,
)  # fmt: skip
_LEVELS = ("info", "warning", "error")

ACTION_KINDS: tuple[ActionKind, ...] = (
    ActionKind(
        "notify",
        "Say it to whoever watches: in the log of ROS and as a diagnostic.",
        By.ROS,
        arguments=(
            _TEXT,
            Argument("level", _T.CHOICE, "How bad it is.", default="warning", choices=_LEVELS),
            Argument(
                "to",
                _T.NAMES,
                "Where it is said: `rosout` is /rosout, `diagnostics` a status on /diagnostics.",
                default=("rosout", "diagnostics"),
                choices=("rosout", "diagnostics"),
            ),
        ),
        details="Use Alertmanager for mail and paging: `roslens watch --prometheus` gives it the same verdicts.",
        touches=False,
    ),
    ActionKind(
        "webhook",
        "Post what happened, as JSON, to a page of the web.",
        By.MONITOR,
        arguments=(
            Argument("url", _T.TEXT, "Where it is posted to: `http://` or `https://`.", required=True),
            Argument("text", _T.TEXT, "What is said; templates are filled in.", default=""),
            _TIMEOUT,
        ),
        details="The JSON has `text`, `reaction`, `entity`, `time` (seconds since the epoch) and `because`. "
        "Redirections are not followed. An answer that is not 2xx is a failure.",
        touches=False,
    ),
    ActionKind(
        "publish",
        "Publish a message, such as an emergency stop.",
        By.ROS,
        arguments=(
            Argument("topic", _T.TOPIC, "Where it is published.", required=True),
            Argument("type", _T.INTERFACE, "Type of the message.", required=True),
            Argument("fields", _T.MAPPING, "Values of its fields; others keep their default.", default={}),
            Argument(
                "how",
                _T.CHOICE,
                "`once`; `latched`: kept for subscribers that come later; `repeated`: again and again until "
                "what it is done about is gone.",
                default="once",
                choices=("once", "latched", "repeated"),
            ),
            Argument("rate", _T.NUMBER, "Of `repeated`, in Hz, up to 100.", default=10.0),
        ),
        details="The publisher is made when reactions begin, so that subscribers know it before it is needed. A field "
        "that the type does not have, or a value that does not fit, is refused then, too.",
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
        details="An answer whose field `success` is false is a failure. A call that was not answered may have been "
        "done all the same: it is reported as failed.",
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
        details="In ROS 2 the node may refuse it, which is a failure with its reason. In ROS 1 it is set in the "
        "parameter server, and nodes that ask it only at their start see nothing of it.",
    ),
    ActionKind(
        "lifecycle",
        "Take a managed node to another state.",
        By.ROS,
        targets=_NODE,
        arguments=(
            Argument(
                "transition",
                _T.CHOICE,
                "What it is asked to do.",
                required=True,
                choices=("configure", "activate", "deactivate", "cleanup", "shutdown"),
            ),
            _TIMEOUT,
        ),
        ros=(2,),
        details="A transition that does not begin in the node's state, or that the node does not manage, is a failure.",
    ),
    ActionKind(
        "unload",
        "Take a component out of its container.",
        By.ROS,
        targets=_NODE,
        arguments=(
            Argument("container", _T.TEXT, "Name of the container's node.", required=True),
            _TIMEOUT,
        ),
        ros=(2,),
        details="The container is asked which of its components has the name.",
    ),
    ActionKind(
        "load",
        "Load a component into a container.",
        By.ROS,
        arguments=(
            Argument("container", _T.TEXT, "Name of the container's node.", required=True),
            Argument("package", _T.TEXT, "Package of the component.", required=True),
            Argument("plugin", _T.TEXT, "Its class: `demo_nodes_cpp::Talker`.", required=True),
            Argument("name", _T.TEXT, "Name that the node gets.", default=""),
            Argument("namespace", _T.TEXT, "Namespace that it gets.", default=""),
            Argument("remap", _T.NAMES, "Remappings: `from:=to`.", default=()),
            Argument("parameters", _T.MAPPING, "Its parameters.", default={}),
            _TIMEOUT,
        ),
        ros=(2,),
        details="Where the container already has a component of that name, nothing is loaded and it is reported as a "
        "failure.",
    ),
    ActionKind(
        "stop",
        "Stop the process of a node.",
        By.HOST,
        targets=_NODE,
        arguments=(_GRACE, _WHOLE),
        details="It is asked to end and not killed: a process that is still there after its grace is a failure. Where "
        "something that supervises it (a launch file's respawn, systemd) starts it again, this is reported, not "
        "fought.",
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
                "A process that is still there after its grace is killed so long later; 0 never.",
                default=5.0,
            ),
            _WHOLE,
        ),
        details="Command line, environment, folder, namespace and parameters are those that the agent recorded while "
        "the process ran. Where what supervises the process has started it again, it is not started twice.",
    ),
    ActionKind(
        "start",
        "Start a node that is gone, as it was.",
        By.HOST,
        targets=_NODE,
        details="As `restart` starts it. A node that runs is left alone, and that is reported as done.",
    ),
    ActionKind(
        "kill",
        "Kill the process of a node, after it had the chance to end.",
        By.HOST,
        targets=_NODE,
        arguments=(_GRACE, _WHOLE),
        details="SIGINT, half of the grace later SIGTERM, then SIGKILL. A process that is stopped or hangs gets "
        "there, too.",
    ),
    ActionKind(
        "command",
        "Run a command that the host has on its allow-list.",
        By.HOST,
        targets=(EntityKind.HOST, EntityKind.NODE),
        arguments=(Argument("name", _T.TEXT, "Under which the allow-list has it.", required=True),),
        details="What is run is in the allow-list alone, as a list of arguments that no shell reads; nothing of it "
        "comes over the line. Of a node, it is run on the host of the node.",
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
        details="One MCAP file for each time, below the folder of the journal. Recent messages are held in "
        "memory, at most 64 MB; beyond that the oldest are dropped. The result states the length of the recording.",
        touches=False,
    ),
    ActionKind(
        "snapshot",
        "Keep how things stand for the post-mortem: graph, verdicts, values, processes, last log lines, /rosout.",
        By.MONITOR,
        details="A folder for each time, below the folder of the journal, with JSON files, a page of text, and what "
        "nodes said on /rosout in the last 60 s as MCAP (`rosout-ros2.mcap`). That is held in memory, at most 64 MB.",
        touches=False,
    ),
)

_BY_KEY = {one.key: one for one in ACTION_KINDS}


def action_kind(key: str) -> ActionKind | None:
    """Return the kind that documents call by ``key``."""
    return _BY_KEY.get(key)
