"""Asks in the terminal whether something may be done, without ever waiting for the answer."""

from __future__ import annotations

import getpass
import os
import select
import sys
from typing import TextIO

from roslens.model.acting.reaction import Decision
from roslens.report.history.journal_text import action_text

_YES, _NO = ("y", "yes"), ("n", "no")


class AskTerminal:
    """Questions with a number each; answers are lines such as ``y``, ``n 3`` or ``y 3``."""

    def __init__(self, stdin: TextIO = sys.stdin, stdout: TextIO = sys.stderr) -> None:
        """Read lines from ``stdin``, write to ``stdout``."""
        self._in = stdin
        self._out = stdout
        self._open: dict[int, str] = {}
        self._count = 0
        self._waiting = b""
        self._closed = False

    def ask(self, decision: Decision, until_s: float) -> None:
        """Ask whether it may be done."""
        import msgspec

        self._count += 1
        self._open[self._count] = decision.id
        because = "; ".join(one.statement for one in decision.because) or decision.entity
        what = action_text({**msgspec.to_builtins(decision.action), "target": str(decision.action.target or "")})
        text = f" ({decision.text})" if decision.text else ""
        left = max(until_s - decision.at_s, 0.0)
        print(
            f"roslens: [{self._count}] {what}{text}, because {because}? y or n within {left:.0f} s (`y {self._count}`)",
            file=self._out, flush=True,
        )  # fmt: skip

    def withdraw(self, decision: str) -> None:
        """Ask no more."""
        for number in [one for one, id_ in self._open.items() if id_ == decision]:
            del self._open[number]
            print(f"roslens: [{number}] is asked no more", file=self._out, flush=True)

    def answers(self) -> list[tuple[str, bool, str]]:
        """Return decisions that were answered since the last time, whether they are allowed, and by whom."""
        return [found for line in self._lines() if (found := self._answer(line)) is not None]

    def _answer(self, line: str) -> tuple[str, bool, str] | None:
        words = line.lower().split()
        if not words:
            return None
        number = int(words[1]) if len(words) == 2 and words[1].isdigit() else None
        if words[0] not in (*_YES, *_NO) or (len(words) > 1 and number not in self._open) or len(words) > 2:
            print(
                f"roslens: {line[:60]!r} is not an answer, expected y or n and a number that is asked", file=self._out
            )
            return None
        if number is None:
            if len(self._open) != 1:
                asked = ", ".join(map(str, self._open)) or "nothing"
                print(f"roslens: which one? Asked is {asked}", file=self._out, flush=True)
                return None
            (number,) = self._open
        return self._open.pop(number), words[0] in _YES, f"{getpass.getuser()} in the terminal"

    def _lines(self) -> list[str]:
        while not self._closed and select.select([self._in], [], [], 0)[0]:
            piece = os.read(self._in.fileno(), 4096)
            if not piece:
                self._closed = True
            self._waiting += piece
        *whole, self._waiting = self._waiting.split(b"\n")
        return [line.decode("utf-8", "replace") for line in whole]


class AskNobody:
    """For modes that do not ask for approval."""

    def ask(self, decision: Decision, until_s: float) -> None:
        """No operator is there."""

    def withdraw(self, decision: str) -> None:
        """No question was asked."""

    def answers(self) -> list[tuple[str, bool, str]]:
        """There is no answer."""
        return []
