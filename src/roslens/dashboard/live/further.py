"""Pages beside the live page, under the same server."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from starlette.routing import BaseRoute


class Further(NamedTuple):
    """Routes of further pages, and what the navigation has of them: address and word."""

    routes: Sequence[BaseRoute] = ()
    links: tuple[tuple[str, str], ...] = ()
