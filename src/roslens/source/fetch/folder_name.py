"""Names of repositories that become folders: none of them leads anywhere but below the folder of all."""

from __future__ import annotations

import re

_PART = re.compile(r"[\w][\w.+@-]*\Z")
_LONGEST = 200


def is_folder_name(name: str) -> bool:
    """Return whether a name is one or more plain parts between ``/``, none of which git or roslens take for theirs."""
    parts = name.split("/")
    return (
        0 < len(name) <= _LONGEST
        and all(_PART.match(part) and part.lower() not in ("con", "nul", "aux") for part in parts)
        and not any(part.lower().endswith((".git", ".lock")) for part in parts)
    )
