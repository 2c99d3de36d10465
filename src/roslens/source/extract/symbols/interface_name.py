"""Names of message, service and action types as code writes them, in the form of ROS 1 or ROS 2."""

from __future__ import annotations

import re
from collections.abc import Collection

from roslens.source.extract.ir.program import Program
from roslens.source.extract.symbols.symbol_table import type_name

_ENDS = re.compile(
    r"(\.|_)?(ConstPtr|SharedPtr|UniquePtr|ConstSharedPtr|ConstUniquePtr|Ptr|ConstWeakPtr|WeakPtr|Request|Response|"
    r"ConstRef|Goal|Result|Feedback)+$"
)
_POINTER_END = re.compile(r"(Const|Shared|Unique|Weak)*Ptr$")
_EVENT = re.compile(r"(?:::)?(?:ros::)?MessageEvent\s*<(.*)>[\s&]*$", re.DOTALL)
_MIDDLE = frozenset({"msg", "srv", "action"})
_NAME = re.compile(r"[A-Za-z_]\w*")
_STANDS_FOR = {"pcl.PointCloud": "sensor_msgs/PointCloud2", "pcl.PCLPointCloud2": "sensor_msgs/PointCloud2"}
"""Classes that are sent as messages of another name (pcl_ros, point_cloud.h; pcl_conversions.h)."""


def interface_name(written: str) -> str:
    """Return ``package/Type`` or ``package/msg/Type`` of a C++ type or dotted Python name; empty where it is none."""
    name, _ = type_name(message_of(written).replace("/", "::"))
    without = _without_end(name)
    if without in _STANDS_FOR:
        return _STANDS_FOR[without]
    pieces = [piece for piece in without.split(".") if piece]
    if len(pieces) >= 3 and pieces[-2].startswith("_") and pieces[-3] in _MIDDLE:
        pieces = [*pieces[:-2], pieces[-1]]
    if len(pieces) >= 5 and pieces[-2] == "Impl":
        # What an action is made of: ``nav2_msgs::action::Spin::Impl::FeedbackMessage``.
        pieces = [*pieces[:-3], f"{pieces[-3]}_{pieces[-1]}"]
    if (
        len(pieces) >= 2
        and pieces[-2][:1].islower()
        and all(_NAME.fullmatch(piece) for piece in pieces)
        and (pieces[-1][:1].isupper() or (len(pieces) == 3 and pieces[1] in _MIDDLE))
    ):
        return "/".join(pieces[-3:] if len(pieces) >= 3 and pieces[-2] in _MIDDLE else pieces[-2:])
    return ""


def message_of(written: str) -> str:
    """Return a type of C++ without ``const``; of an event of a message (``ros::MessageEvent<M const>``) the message."""
    text = written.replace(" const", " ").replace("const ", " ").strip()
    event = _EVENT.match(text)
    return text if event is None else event[1].strip()


def included_interface(written: str, program: Program) -> str:
    """Return the type that a name without package means by what a file includes: ``navfn/MakeNavPlan.h``."""
    name, _ = type_name(message_of(written))
    last = _without_end(f"x.{name}").removeprefix("x.").rpartition(".")[2]
    for written_header, _line in program.includes:
        header = written_header.strip('<>"')
        if header.endswith(f"/{last}.h") and header.count("/") == 1:
            return f"{header.partition('/')[0]}/{last}"
    return ""


def used_interface(written: str, kind: str, using: Collection[str], headers: Collection[str]) -> str:
    """Return the type that a name means by a namespace that is used whole, as ``using namespace package::msg``.

    Args:
        written: the name, without a namespace.
        kind: ``msg``, ``srv`` or ``action``.
        using: namespaces, joined by ``.``.
        headers: that are included: ``package/msg/the_name.hpp`` tells that the package has it.
    """
    spaces = [one.replace(".", "/") for one in using if one.endswith(f".{kind}")]
    header = f"{written.lower()}.hpp"
    known = {
        space
        for space in spaces
        for one in headers
        if one.startswith(f"{space}/") and one.rpartition("/")[2].replace("_", "").lower() == header.replace("_", "")
    }
    return f"{known.pop()}/{written}" if len(known) == 1 else ""


def lower_interface(written: str, headers: Collection[str]) -> str:
    """Return a type of ROS 1 whose name begins with a small letter, where a header of that name is included.

    Args:
        written: type of C++: ``autorally_msgs::runstop``.
        headers: that are included anywhere: ``autorally_msgs/runstop.h``.
    """
    name, _ = type_name(written.replace(" const", " ").replace("const ", " ").strip())
    found = "/".join(piece for piece in _without_end(name).split(".") if piece)
    return found if found.count("/") == 1 and f"{found}.h" in headers else ""


def of_generation(name: str, generation: str, kind: str) -> str:
    """Return a type name in the form of a generation; Python of ROS 1 writes ``package.msg.Type`` too."""
    pieces = name.split("/")
    if generation == "ros1" and len(pieces) == 3:
        return f"{pieces[0]}/{pieces[2]}"
    if generation == "ros2" and len(pieces) == 2:
        return f"{pieces[0]}/{kind}/{pieces[1]}"
    return name


def _without_end(name: str) -> str:
    head, dot, last = name.rpartition(".")
    if not head:
        return name
    around = head.rpartition(".")[2]
    if around in _MIDDLE or around[:1] == "_" or (around == head and head[:1].islower()):
        # Nothing but the package is before it: a message may be named ``Feedback`` itself.
        shorter = _POINTER_END.sub("", last)
        return f"{head}{dot}{shorter or last}"
    if _ENDS.fullmatch(f".{last}"):
        return _without_end(head)
    shorter = re.sub(r"(ConstPtr|ConstSharedPtr|SharedPtr|Ptr)$", "", last) if last.endswith("Ptr") else last
    return f"{head}{dot}{shorter or last}"
