"""Who asks, and what they may do."""

from __future__ import annotations

from enum import Enum

import msgspec
from starlette.requests import HTTPConnection

SCOPE_KEY = "roslens.person"
"""Under which the guard leaves the person in the scope of a request."""


class Role(Enum):
    """The permissions of a person; operators may also view."""

    VIEW = "view"
    OPERATE = "operate"


class Person(msgspec.Struct, frozen=True):
    """Who holds a token, by the name that records of acts carry."""

    name: str
    role: Role

    @property
    def may_operate(self) -> bool:
        """Whether acting requests of theirs are answered."""
        return self.role is Role.OPERATE


ANYBODY = Person("anybody", Role.VIEW)
"""Who has no token where none is needed to view."""


def person_of(request: HTTPConnection) -> Person:
    """Return who sent a request that the guard let through; whom it did not look at may view only."""
    found = request.scope.get(SCOPE_KEY)
    return found if isinstance(found, Person) else ANYBODY
