"""Messages of ROS itself (``std_msgs``, ``geometry_msgs`` …), which workspaces use and do not contain.

Their definitions are those of the library rosbags: of Noetic for ROS 1, of Jazzy for ROS 2.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

from roslens.source.extract.interfaces.interface import Interface
from roslens.source.extract.interfaces.interface_file import read_interface

if TYPE_CHECKING:
    from rosbags.typesys.store import Typestore

_END = "=" * 80
"""Begins the definitions of the messages that one contains."""


@lru_cache(maxsize=2)
def _store(generation: int) -> Typestore:
    from rosbags.typesys import Stores, get_typestore

    return get_typestore(Stores.ROS1_NOETIC if generation == 1 else Stores.ROS2_JAZZY)


@lru_cache(maxsize=1024)
def published_interface(generation: int, name: str) -> Interface | None:
    """Return a message of ROS by its full name (``std_msgs/msg/Header``); None where ROS has none of that name."""
    store = _store(generation)
    package, kind, short = (*name.split("/"), "", "")[:3]
    if kind != "msg" or name not in store.fielddefs:
        return None
    definition, _ = store.generate_msgdef(name, ros_version=generation)
    own = definition.partition(_END)[0]
    return read_interface(own.encode(), f"{short}.msg", package, generation)[0]
