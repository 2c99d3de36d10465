"""What could not be done: a result like any other, shown and never dropped."""

from __future__ import annotations

import msgspec

from roslens.model.source import Location


class Failure(msgspec.Struct, frozen=True, omit_defaults=True):
    """Something that could not be analysed, and what to do about it.

    ``what`` quotes what was found, ``expected`` says what should have been there, ``advice`` what
    to do next. ``tool`` is the plug-in or the step (``workspace``, ``syntax``, ``metrics``,
    ``cccc``…). ``partial`` is true where the rest of the entity was still analysed. ``package`` is
    the id of the package concerned. ``detail`` holds a traceback or a tool's output for the log.
    """

    tool: str
    what: str
    expected: str = ""
    advice: str = ""
    location: Location | None = None
    entity: str = ""
    package: str = ""
    partial: bool = False
    detail: str = ""

    def __str__(self) -> str:
        """Return the message form: what, where, what was expected, what to do next."""
        where = str(self.location) if self.location else self.entity
        text = f"{where}: {self.what}" if where else self.what
        if self.expected:
            text += f"; expected {self.expected}"
        if self.advice:
            text += f". {self.advice}"
        return text
