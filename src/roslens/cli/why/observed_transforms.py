"""The transforms of a ROS 2 system that runs: a process of its own listens for a while, beside the observers."""

from __future__ import annotations

import os
import subprocess

import msgspec

from roslens.children.safe_path import NEUTRAL
from roslens.compare.why.recorded import RecordedTransforms
from roslens.live.adapters.child import clean_environment, find_ros2_python, ros2_command
from roslens.model.transforms.heard import HeardTransforms
from roslens.model.transforms.probe import probed
from roslens.model.transforms.tree import tree_of

LISTEN_S = 2.0
"""By default; a transform that is said every 0.2 s has a rate then."""
_MODULE = "roslens.live.adapters.ros2.transforms"
_PATIENCE_S = 30.0
_SECOND = 1_000_000_000


class TransformListener:
    """A process that listens to transforms."""

    def __init__(self, python: str, domain: int | None, seconds: float) -> None:
        """Start to listen for ``seconds`` with a Python that has rclpy, or one that is found.

        Raises:
            UsageError: there is none.
        """
        words = ["--for", str(seconds), *(["--domain", str(domain)] if domain is not None else [])]
        command = ros2_command(find_ros2_python(python, os.environ), words, _MODULE)
        self._seconds = seconds
        self._process = subprocess.Popen(
            command, env=clean_environment(os.environ), cwd=NEUTRAL, stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        )  # fmt: skip

    def heard(self) -> HeardTransforms | str:
        """Wait for what was heard; else a sentence why nothing was."""
        try:
            result, said = self._process.communicate(timeout=self._seconds + _PATIENCE_S)
        except subprocess.TimeoutExpired:
            self.close()
            return "transforms could not be listened to: no answer in time"
        if self._process.returncode:
            reason = said.decode(errors="replace").strip().rpartition("\n")[2]
            return f"transforms could not be listened to: {reason or 'the listener ended'}"
        try:
            return msgspec.msgpack.decode(result, type=HeardTransforms)
        except msgspec.DecodeError as error:
            return f"transforms could not be listened to: {error}"

    def close(self) -> None:
        """End it, where it still runs."""
        if self._process.poll() is None:
            self._process.kill()
        self._process.communicate()


def observed_transforms(
    heard: HeardTransforms, pair: tuple[str, ...], publishers: tuple[str, ...]
) -> RecordedTransforms:
    """Return the frames that were heard of, and what look-ups between two of them came to."""
    tries = probed(heard.transforms, pair[0], pair[1], round(heard.end * _SECOND)) if len(pair) > 1 else None
    return RecordedTransforms(tree_of(heard.transforms), heard.topics, publishers, tries)
