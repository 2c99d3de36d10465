"""Messages that services and actions of ROS 1 consist of, as its generators derive them.

By genmsg ``XRequest`` and ``XResponse`` of a service; by genaction of actionlib_msgs ``XGoal``, ``XResult``,
``XFeedback``, ``XActionGoal``, ``XActionResult``, ``XActionFeedback`` and ``XAction`` of an action. What ROS 2 derives
has names of its own beside the interface: :mod:`~roslens.source.extract.interfaces.type_hash`.
"""

from __future__ import annotations

from roslens.source.extract.interfaces.interface import FieldType, Interface, InterfaceField, Message


def ros1_messages(interface: Interface) -> tuple[Interface, ...]:
    """Return the messages that a service or action of ROS 1 consists of; none of a message."""
    name = interface.name
    if interface.kind == "srv":
        names = (f"{name}Request", f"{name}Response")
        return tuple(_beside(interface, *one) for one in zip(names, interface.parts, strict=True))
    if interface.kind != "action":
        return ()
    parts = zip((f"{name}Goal", f"{name}Result", f"{name}Feedback"), interface.parts, strict=True)
    header = _field("header", "Header", "std_msgs")
    identity, status = _field("goal_id", "GoalID", "actionlib_msgs"), _field("status", "GoalStatus", "actionlib_msgs")

    def own(field: str, type_: str) -> InterfaceField:
        return _field(field, f"{name}{type_}", interface.package)

    derived = {
        f"{name}ActionGoal": (header, identity, own("goal", "Goal")),
        f"{name}ActionResult": (header, status, own("result", "Result")),
        f"{name}ActionFeedback": (header, status, own("feedback", "Feedback")),
        f"{name}Action": (
            own("action_goal", "ActionGoal"),
            own("action_result", "ActionResult"),
            own("action_feedback", "ActionFeedback"),
        ),
    }
    return (
        *(_beside(interface, *one) for one in parts),
        *(_beside(interface, one, Message(fields)) for one, fields in derived.items()),
    )


def _beside(interface: Interface, name: str, message: Message) -> Interface:
    return Interface(interface.package, name, "msg", interface.generation, (message,), interface.complete)


def _field(name: str, type_: str, package: str) -> InterfaceField:
    return InterfaceField(name, FieldType(type_, package))
