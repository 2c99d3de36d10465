"""Numbers out of messages, decoded with the definitions of the recording or, without any, those that rosbags brings."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection
from functools import lru_cache
from typing import Any, TypeAlias

from roslens.live.adapters.bag.block import Message
from roslens.live.adapters.bag.channel import Channel
from roslens.live.adapters.bag.damage import DamageError
from roslens.live.adapters.bag.decompress import most_unpacked, unpack_start

_PATH = re.compile(r"[A-Za-z_]\w*(?:\[\d+\])*(?:\.[A-Za-z_]\w*(?:\[\d+\])*)*")
_STEP = re.compile(r"([A-Za-z_]\w*)|\[(\d+)\]")

# Words of ROS 1 for the fields of times; rosbags uses those of ROS 2, and appends "_" to words of Python.
_SPELLINGS = {"secs": "sec", "nsecs": "nanosec"}

Step: TypeAlias = "str | int"


def steps_of(path: str) -> list[Step]:
    """Return the names and indexes of a path such as ``pose.position.x`` or ``ranges[0]``.

    Raises:
        ValueError: the text is no such path.
    """
    if not _PATH.fullmatch(path):
        raise ValueError(path)
    return [found[1] or int(found[2]) for found in _STEP.finditer(path)]


class MessageReader:
    """Decodes the messages of one channel.

    Raises:
        DamageError: the type is not known or its definition cannot be read.
    """

    def __init__(self, channel: Channel) -> None:
        self._decode = _decoder(channel)
        self._compression = channel.compression

    def read(self, message: Message) -> Any:
        """Return a message with its fields as attributes.

        Raises:
            DamageError: the message cannot be decoded.
        """
        content = message.content
        if self._compression:
            content, reason = unpack_start(content, self._compression, most_unpacked(len(content)))
            if reason:
                raise DamageError(reason)
        try:
            return self._decode(content)
        except Exception as error:  # noqa: BLE001 - generated code meets arbitrary bytes
            raise DamageError(f"a message that cannot be decoded: {error!r}") from None


class FieldReader:
    """Reads some fields of the messages of one channel.

    Raises:
        DamageError: the type is not known or its definition cannot be read, or a path is none.
    """

    def __init__(self, channel: Channel, paths: Collection[str]) -> None:
        try:
            self._paths = {path: steps_of(path) for path in paths}
        except ValueError as error:
            raise DamageError(
                f'"{error}", which is not a path of a field such as pose.position.x or ranges[0]'
            ) from None
        self._messages = MessageReader(channel)
        self.absent: set[str] = set()

    def read(self, message: Message) -> dict[str, float]:
        """Return the fields of a message that are there and are numbers; notes in ``absent`` which never were.

        Raises:
            DamageError: the message cannot be decoded.
        """
        decoded = self._messages.read(message)
        values = {}
        for path, steps in self._paths.items():
            value = _follow(decoded, steps)
            if value is None:
                self.absent.add(path)
            else:
                values[path] = value
        return values


def _follow(value: Any, steps: list[Step]) -> float | None:
    for step in steps:
        if isinstance(step, str):
            value = getattr(value, _SPELLINGS.get(step, step), getattr(value, f"{step}_", None))
        else:
            value = value[step] if hasattr(value, "__len__") and step < len(value) else None
    if value is None or isinstance(value, str | bytes) or hasattr(value, "__len__"):
        return None
    try:
        return float(value)
    except (TypeError, ValueError):
        return None


def _decoder(channel: Channel) -> Callable[[bytes], object]:
    """Return what decodes the messages of a channel."""
    return _decoder_of(channel.type, channel.encoding, channel.language, channel.definition)


@lru_cache(maxsize=64)
def _decoder_of(kind: str, encoding: str, language: str, definition: str) -> Callable[[bytes], object]:
    from rosbags.typesys import Stores, get_types_from_idl, get_types_from_msg, get_typestore
    from rosbags.typesys.msg import normalize_msgtype

    if encoding not in {"ros1", "cdr"}:
        raise DamageError(f'messages encoded as "{encoding}", which is not supported')
    name = normalize_msgtype(kind)
    try:
        if language:
            # A store for each type: recordings joined from several may hold two versions of a part.
            store = get_typestore(Stores.EMPTY)
            types = get_types_from_idl(definition) if language == "idl" else None
            store.register(types if types is not None else get_types_from_msg(definition, name))
        else:
            store = get_typestore(Stores.ROS1_NOETIC if encoding == "ros1" else Stores.LATEST)
        store.get_msgdef(name)
    except Exception as error:  # noqa: BLE001 - a definition is any text, and parsing it fails in many ways
        raise DamageError(f'the type "{kind}", whose definition cannot be used: {error!r}') from None
    if encoding == "ros1":
        return lambda content: store.deserialize_ros1(content, name)
    return lambda content: store.deserialize_cdr(content, name)
