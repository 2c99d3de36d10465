"""What a foreign tool may touch: the workspace to read, its own scratch to write, its own program."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

from roslens.children.sandbox import Sandbox, is_narrow, program_folders
from roslens.source.tools.tool import Request

_BUILT = ("build", "install", "devel")
"""Folders beside ``src`` in which colcon and catkin leave headers that code includes."""


def sandbox_of(request: Request, *, network: bool = False) -> Sandbox:
    """Return what a call of a tool may touch."""
    return Sandbox(
        read=readable(request.root, request.packages.values()),
        run=program_folders(request.program),
        write=(request.scratch,),
        network=network,
    )


def readable(root: str, packages: Iterable[str]) -> tuple[str, ...]:
    """Return the workspace, packages that it has by a link, and what was built of it beside it."""
    whole = os.path.realpath(root)
    places = [whole]
    for folder in packages:
        real = os.path.realpath(os.path.join(root, folder))  # noqa: PTH118
        if not (real + os.sep).startswith(whole.rstrip(os.sep) + os.sep) and is_narrow(real):
            places.append(real)
    if Path(whole).name == "src":
        places += [str(Path(whole).with_name(name)) for name in _BUILT]
    return tuple(dict.fromkeys(places))
