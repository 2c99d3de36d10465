"""What ROS takes as a name: the rules of rmw and rcl (``rmw_validate_full_topic_name``) and of ROS 1."""

from __future__ import annotations

import re

_ALLOWED = re.compile(r"^[A-Za-z0-9_/~{}]*$")
_NODE = re.compile(r"^[A-Za-z_][A-Za-z0-9_]*$")


def topic_fault(name: str, *, ros1: bool) -> str:
    """Return why ROS refuses the name of a topic or service, empty where it takes it."""
    if not name:
        # roscpp takes the namespace of the handle then, as `image_transport` does with the topic that it was given.
        return "" if ros1 else "is empty"
    plain = re.sub(r"\{\w*\}", "x", name)
    strange = sorted({one for one in plain if not _ALLOWED.match(one)})
    if strange:
        return f"has {strange[0]!r} in it"
    if "{" in plain or "}" in plain:
        return ""
    if "~" in plain[1:]:
        return "has a ~ behind its beginning"
    if ros1:
        # `ros::names::validate` looks at the first character of the whole name: `/2d_map` is one.
        return "begins with a digit" if plain[:1].isdigit() else ""
    return _fault_in_ros2(plain)


def _fault_in_ros2(plain: str) -> str:
    """Return why ROS 2 refuses a name of allowed characters, whose substitutions are replaced."""
    if plain.startswith("~") and len(plain) > 1 and not plain.startswith("~/"):
        return "has no / behind its ~"
    if plain.endswith("/") and len(plain) > 1:
        return "ends with /"
    if "//" in plain:
        return "has // in it"
    if any(token[:1].isdigit() for token in plain.lstrip("~/").split("/")):
        return "has a part that begins with a digit"
    return ""


def node_fault(name: str) -> str:
    """Return why ROS refuses the name of a node, empty where it takes it."""
    if _NODE.match(name):
        return ""
    strange = sorted({one for one in name if not (one.isascii() and (one.isalnum() or one == "_"))})
    if strange:
        return f"has {strange[0]!r} in it"
    return "is empty" if not name else "begins with a digit"
