"""What reads and writes bags: of a node it makes nothing, whether its source is in the workspace or not."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Obj, Value
from roslens.source.extract.interpreter.vocabulary import CallSite, outer

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context


@outer("rosbag.Bag", quiet=True)
def bag(_: Context, __: Value, called: CallSite) -> Obj:
    """A file of messages: where ROS itself is in the workspace, its insides would be followed by whoever has one."""
    return Obj(called.name)
