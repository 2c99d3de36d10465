"""The stamp in the header of messages, read at its fixed place without decoding the message."""

from __future__ import annotations

import re

import numpy as np

from roslens.live.adapters.bag.block import NO_STAMP, Bytes, Ints
from roslens.live.adapters.bag.channel import Channel
from roslens.live.adapters.bag.layout import numbers_at

STAMPED_ENCODINGS = ("ros1", "cdr")
_SECOND = 1_000_000_000
# CDR has four bytes of encapsulation before the stamp, ROS 1 the four of the sequence number.
_STAMP_AT = 4
_NEEDED = 12

_HEADER_FIELD = re.compile(r"(?:std_msgs/(?:msg/)?)?Header\s+\w+")
_CONSTANT = re.compile(r"[\w/]+(?:<=\d+)?\s+\w+\s*=")
_IDL_TEXT = re.compile(r'"(?:[^"\\]|\\.)*"')
_IDL_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
_IDL_FIRST = re.compile(r"\bstruct\s+(\w+)\s*\{\s*(?:@[\w.]+(?:\s*\([^)]*\))?\s*)*([\w:]+)\s+\w+\s*;")


def begins_with_header(channel: Channel) -> bool:
    """Return whether the stamp of the channel's messages lies at the fixed place."""
    if channel.encoding not in STAMPED_ENCODINGS or channel.compression:
        return False
    if channel.language == "idl":
        return _idl_begins_with_header(channel)
    if channel.language == "msg":
        return _msg_begins_with_header(channel.definition)
    return _known_type_begins_with_header(channel.type)


def _msg_begins_with_header(definition: str) -> bool:
    for line in definition.splitlines():
        text = line.partition("#")[0].strip()
        if text.startswith("===="):
            return False
        if not text or _CONSTANT.match(text):
            continue
        return _HEADER_FIELD.fullmatch(text) is not None
    return False


def _idl_begins_with_header(channel: Channel) -> bool:
    name = channel.type.rpartition("/")[2]
    bare = _IDL_COMMENT.sub("", _IDL_TEXT.sub('""', channel.definition))
    firsts = {found[1]: found[2] for found in _IDL_FIRST.finditer(bare)}
    return firsts.get(name, "").strip(":") == "std_msgs::msg::Header"


def _known_type_begins_with_header(name: str) -> bool:
    """Look at the definitions that rosbags brings, for recordings that store none."""
    from rosbags.typesys import Stores, get_typestore

    known = get_typestore(Stores.LATEST).fielddefs
    fields = known[name][1] if name in known else []
    return bool(fields) and fields[0][1][1] == "std_msgs/msg/Header"


def stamps_of(content: Bytes, starts: Ints, sizes: Ints, channel: Channel) -> Ints:
    """Return the stamps of messages in nanoseconds, `NO_STAMP` where there is none or it was never set."""
    stamps = np.full(len(starts), NO_STAMP, np.int64)
    long = np.flatnonzero(sizes >= _NEEDED)
    at = starts[long]
    seconds = numbers_at(content, at + _STAMP_AT, np.uint32)
    nanoseconds = numbers_at(content, at + _STAMP_AT + 4, np.uint32)
    if channel.encoding == "cdr":
        # The second byte of the encapsulation is odd where numbers are little-endian.
        turned = content[at + 1] & 1 == 0
        seconds = np.where(turned, seconds.byteswap(), seconds).view(np.int32)
        nanoseconds = np.where(turned, nanoseconds.byteswap(), nanoseconds)
    whole = seconds.astype(np.int64) * _SECOND + nanoseconds
    stamps[long] = np.where(whole == 0, NO_STAMP, whole)
    return stamps
