"""What this process and its worker processes say to each other.

A frame is four bytes of length, big-endian, and a msgpack text. Tasks go to a worker; for each task it
answers with any number of :class:`Began` and :class:`Gave` and one :class:`Ended`.
"""

from __future__ import annotations

from typing import Any, BinaryIO

import msgspec

from roslens.model.failure import Failure
from roslens.model.quantity import Measurement
from roslens.plugins.member import LoadSpec
from roslens.plugins.outcome import RawFinding
from roslens.plugins.points import FileInput, Manifest, PackageInput, ResultsInput, WorkspaceInput


class Step(msgspec.Struct, frozen=True, array_like=True):
    """One call that can fail alone: a plug-in and a name that is unique in its task."""

    plugin: str
    name: str


LOST_CONNECTION = 75
"""Exit code of a worker whose pipe to its parent was closed by a plug-in."""

LOADING = "loading"
"""Name of the step in which a plug-in is imported; when it fails, no other step of it runs."""


class Engaged(msgspec.Struct, frozen=True, array_like=True):
    """A plug-in as a worker needs it, with the options of the user."""

    name: str
    spec: LoadSpec
    options: dict[str, Any]


class LoadTask(msgspec.Struct, frozen=True, tag="load"):
    """Import a plug-in and say what it is."""

    name: str
    spec: LoadSpec


class FilesTask(msgspec.Struct, frozen=True, tag="files"):
    """Call the file hooks of plug-ins for files of a package, whose contents the worker reads.

    ``paths`` are all files of the package: findings may lie in any of them.
    """

    plugins: tuple[Engaged, ...]
    root: str
    folder: str
    package: str
    paths: tuple[str, ...]
    files: tuple[FileInput, ...]


class PackageTask(msgspec.Struct, frozen=True, tag="package"):
    """Call the package hook of a plug-in."""

    plugin: Engaged
    root: str
    package: PackageInput


class WorkspaceTask(msgspec.Struct, frozen=True, tag="workspace"):
    """Call the workspace hook of a plug-in, or its repository hook where a repository is named."""

    plugin: Engaged
    workspace: WorkspaceInput


class ResultsTask(msgspec.Struct, frozen=True, tag="results"):
    """Call the hook of a plug-in that sees what all plug-ins reported."""

    plugin: Engaged
    results: ResultsInput


Task = LoadTask | FilesTask | PackageTask | WorkspaceTask | ResultsTask


class Order(msgspec.Struct, frozen=True):
    """A task, without the steps that are done and those that took a worker down."""

    task: Task
    done: frozenset[Step] = frozenset()
    dead: frozenset[Step] = frozenset()


class Began(msgspec.Struct, frozen=True, tag="began"):
    """A step begins: the time limit starts anew. It is about the file and package named, if any."""

    step: Step
    path: str = ""
    package: str = ""


class Gave(msgspec.Struct, frozen=True, tag="gave"):
    """What a step reported, its exception included; ``over`` unless it goes on after a part of it.

    ``printed`` is how many bytes the worker's output had by then, -1 where that is unknown: what it prints before its
    parent reads this belongs to the next step.
    """

    step: Step
    findings: tuple[RawFinding, ...] = ()
    measurements: tuple[Measurement, ...] = ()
    failures: tuple[Failure, ...] = ()
    over: bool = True
    printed: int = -1


class Loaded(msgspec.Struct, frozen=True, tag="loaded"):
    """A plug-in was imported; ``failure`` says why it cannot be used."""

    manifest: Manifest | None = None
    hooks: tuple[str, ...] = ()
    fingerprint: str = ""
    failure: Failure | None = None


class Ended(msgspec.Struct, frozen=True, tag="ended"):
    """A task is over."""


Answer = Began | Gave | Loaded | Ended

ORDER_DECODER = msgspec.msgpack.Decoder(Order)
_ANSWER_DECODER = msgspec.msgpack.Decoder(Answer)
_LENGTH = 4

MOST_ANSWER_BYTES = 32_000_000
"""Of one answer; a file with ten thousand findings makes some megabytes."""

MOST_TASK_BYTES = 128_000_000
"""Of all answers to one task."""


class TooMuchError(ValueError):
    """A worker says more than is taken in; the message says how much that is."""


def frame(message: msgspec.Struct) -> bytes:
    """Return a message as a frame."""
    body = msgspec.msgpack.encode(message)
    return len(body).to_bytes(_LENGTH, "big") + body


def read_frame(stream: BinaryIO) -> bytes | None:
    """Return the body of the next frame of a blocking stream, None at its end."""
    head = stream.read(_LENGTH)
    if len(head) < _LENGTH:
        return None
    body = stream.read(int.from_bytes(head, "big"))
    return body if len(body) == int.from_bytes(head, "big") else None


class AnswerBuffer:
    """Puts answers together from the pieces a pipe delivers."""

    def __init__(self) -> None:
        """Start empty."""
        self._bytes = bytearray()
        self._taken = 0

    def begin(self) -> None:
        """Count the answers to another task."""
        self._taken = 0

    def feed(self, piece: bytes) -> list[Answer]:
        """Return the answers that the piece completes.

        Raises:
            TooMuchError: an answer, or those to this task together, are too long.
            msgspec.DecodeError: something else wrote into the pipe.
        """
        self._bytes += piece
        self._taken += len(piece)
        if self._taken > MOST_TASK_BYTES:
            raise TooMuchError(f"it reported more than {MOST_TASK_BYTES:,} bytes for one task")
        answers: list[Answer] = []
        while len(self._bytes) >= _LENGTH:
            length = int.from_bytes(self._bytes[:_LENGTH], "big")
            if length > MOST_ANSWER_BYTES:
                raise TooMuchError(f"it reported {length:,} bytes at once; at most {MOST_ANSWER_BYTES:,} are taken")
            end = _LENGTH + length
            if len(self._bytes) < end:
                break
            answers.append(_ANSWER_DECODER.decode(bytes(self._bytes[_LENGTH:end])))
            del self._bytes[:end]
        return answers
