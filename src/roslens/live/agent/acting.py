"""An agent that acts: the line of requests, the gate, the hand, and the journal of all three."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, Protocol

import msgspec

from roslens.live.agent.allow_list import read_allow_list
from roslens.live.agent.enrol import AgentEnrolment
from roslens.live.agent.host_hand import Done, HostHand
from roslens.live.agent.process_record import ProcessRecords
from roslens.live.agent.request_gate import RequestGate
from roslens.live.agent.request_line import RequestLine
from roslens.model.acting.host_request import HostRequest


class Writing(Protocol):
    """A journal."""

    def add(self, what: str, time: float, **fields: Any) -> object:
        """Append an entry, on the disk when this returns."""


class Acting:
    """Takes requests until it is closed.

    Attributes:
        records: how the processes of nodes were started; to learn which processes hold nodes.
    """

    def __init__(
        self, host: str, address: tuple[str, int], enrolment: AgentEnrolment, journal: Writing, *,
        say: Callable[[str], None], wall: Callable[[], float], output: Path, held: Callable[[], str],
    ) -> None:  # fmt: skip
        """Act on this ``host`` for the monitor at ``address``.

        Raises:
            DocumentError: the allow-list is wrong.
            UsageError: what was enrolled is not usable.
        """
        self.records = ProcessRecords()
        self._journal = journal
        self._wall = wall
        self._line = RequestLine(host, address, enrolment, say)
        hand = HostHand(
            read_allow_list(enrolment.allow),
            self.records,
            self._reported,
            announce=self._announce,
            output=output,
            held=held,
        )
        self._line.start(RequestGate(hand, self._refusal, self._refused))

    def close(self) -> None:
        """Take no more."""
        self._line.close()

    def _announce(self, request: HostRequest) -> None:
        reported = msgspec.to_builtins(request)
        self._journal.add("announced", self._wall(), decision=request.id, request=reported)

    def _reported(self, done: Done) -> None:
        result = "done" if done.done else "refused" if done.refused else "failed"
        self._journal.add(
            "outcome",
            self._wall(),
            decision=done.id,
            result=result,
            text=done.text,
            duration_s=round(done.duration_s, 4),
        )
        self._line.tell(done)

    def _refusal(self, text: str) -> None:
        self._journal.add("refused", self._wall(), text=text)

    def _refused(self, request: HostRequest, why: str) -> None:
        self._line.tell(Done(request.id, False, True, why))
