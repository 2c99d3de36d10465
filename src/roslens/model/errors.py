"""Errors a user can act on.

RoslensError
├── UsageError        the command line, a path or a configuration is wrong   exit code 2
├── DocumentError     a model, reference or configuration file is wrong      exit code 2
├── StoreError        the store cannot be read, written or locked            exit code 2
└── PluginError       a plug-in cannot be loaded                             becomes a failure
"""

from __future__ import annotations

from roslens.model.source import Location


class RoslensError(Exception):
    """An error in the message form: what was found, where, what was expected, what to do next."""

    def __init__(self, what: str, *, where: Location | str = "", expected: str = "", advice: str = "") -> None:
        """Keep the parts of the message; ``what`` quotes what was found."""
        self.what = what
        self.where = str(where)
        self.expected = expected
        self.advice = advice
        super().__init__(str(self))

    def __str__(self) -> str:
        """Return the message form on one line."""
        text = f"{self.where}: {self.what}" if self.where else self.what
        if self.expected:
            text += f"; expected {self.expected}"
        if self.advice:
            text += f". {self.advice}"
        return text


class UsageError(RoslensError):
    """The command line, a path or the environment is wrong."""


class DocumentError(RoslensError):
    """A model, reference or configuration file is not valid."""


class StoreError(RoslensError):
    """The store cannot be read, written or locked."""


class PluginError(RoslensError):
    """A plug-in cannot be loaded or broke its contract."""
