"""How much an evaluation of CMake files may take: commands, characters, and how deep they are nested."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from roslens.source.extract.builds.cmake_signals import ExhaustedError

MOST_STEPS = 15_000
MOST_LENGTH = 100_000
MOST_TEXT = 10_000_000
MOST_ROUNDS = 1_000
MOST_DEPTH = 40


class Limits:
    """What one evaluation has taken so far."""

    __slots__ = ("_depth", "_steps", "_text")

    def __init__(self) -> None:
        """Begin with nothing taken."""
        self._steps = self._text = self._depth = 0

    @property
    def spent(self) -> bool:
        """Whether commands or characters are used up, which are not given back by going up."""
        return self._steps > MOST_STEPS or self._text > MOST_TEXT

    @property
    def nested(self) -> bool:
        """Whether something is around what is run."""
        return self._depth > 0

    def spend(self, text: int) -> None:
        """Count characters that are made.

        Raises:
            ExhaustedError: they are too many.
        """
        self._text += text
        if self._text > MOST_TEXT:
            raise ExhaustedError(f"it produces more than {MOST_TEXT:,} characters")

    @contextmanager
    def deeper(self) -> Iterator[None]:
        """Count how deep blocks, calls and files are nested.

        Raises:
            ExhaustedError: they are nested too deep.
        """
        self._depth += 1
        try:
            if self._depth > MOST_DEPTH:
                raise ExhaustedError(f"blocks, calls and files are nested more than {MOST_DEPTH} deep")
            yield
        finally:
            self._depth -= 1

    def step(self) -> None:
        """Count a command or a round of a loop.

        Raises:
            ExhaustedError: they are too many.
        """
        self._steps += 1
        if self._steps > MOST_STEPS:
            raise ExhaustedError(f"it takes more than {MOST_STEPS:,} commands")
