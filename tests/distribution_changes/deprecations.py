"""What code marks as deprecated: for a person to read, as a mark does not say the full name of what it is on."""

from __future__ import annotations

import re
from collections.abc import Iterator

from distribution_changes.revision import Revision

_MARK = re.compile(
    r"\[\[deprecated(?:\(\s*(?P<said>(?:\"[^\"]*\"\s*)+)\))?\s*\]\]\s*(?P<on>[^;{]{0,200})"
    r"|(?P<warns>warnings?\.warn\([^)]*DeprecationWarning|@deprecated\()",
    re.DOTALL,
)


def marked(revision: Revision) -> Iterator[str]:
    """Yield ``path: what is marked, and what the mark says``."""
    paths = [
        one for one in revision.paths if one.endswith((".h", ".hpp", ".py")) and not re.search(r"(?:^|/)tests?/", one)
    ]
    for path, text in revision.read(paths).items():
        for match in _MARK.finditer(text):
            said = " ".join((match["said"] or match["warns"] or "").replace('"', "").split())
            on = " ".join((match["on"] or "").split())
            yield f"{path}: {on[:100]} ({said[:120]})"
