"""Frames on standard output, numbered, none longer than a reader takes."""

from __future__ import annotations

from typing import BinaryIO

import msgspec

from roslens.live.adapters.ros1.names import TOOL
from roslens.model.failure import Failure
from roslens.model.wire import MAX_FRAME_BYTES, Frame, encode_frame


class Speaker:
    """Numbers frames and writes them."""

    def __init__(self, into: BinaryIO) -> None:
        self._into = into
        self._sequence = 0

    def say(self, frame: Frame) -> None:
        """Write a frame; one that is too long is replaced by a failure."""
        numbered = msgspec.structs.replace(frame, sequence=self._sequence)
        body = encode_frame(numbered)
        if len(body) > MAX_FRAME_BYTES:
            what = f"a frame of {len(body):,} bytes with {len(frame.tallies):,} connections was not sent"
            expected = f"at most {MAX_FRAME_BYTES:,} bytes"
            failure = Failure(TOOL, what, expected, "See which program registers so much", partial=True)
            shed = len(frame.tallies) + len(frame.events) + bool(frame.graph)
            body = encode_frame(
                Frame(frame.version, frame.sender, self._sequence, frame.time, failures=[failure], shed=shed)
            )
        self._sequence += 1
        self._into.write(body)
        self._into.flush()
