"""Pages beside the live page, under the same server."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from starlette.routing import BaseRoute


class Further(NamedTuple):
    """Routes of further pages, what the navigation has of them (address and word), and how many questions wait."""

    routes: Sequence[BaseRoute] = ()
    links: tuple[tuple[str, str], ...] = ()
    waiting: Callable[[], int] = int
