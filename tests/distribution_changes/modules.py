"""Public modules of Python that a distribution has and the next one has not."""

from __future__ import annotations

import re
from collections.abc import Sequence

from distribution_changes.revision import Revision
from distribution_changes.row import Row

_ASIDE = re.compile(r"(?:^|/)(?:test|tests|doc|docs|examples?|demos?|tutorials?|launch|scripts|conf|setup)(?:/|\.py$)")


def module_rows(revisions: Sequence[Revision]) -> list[Row]:
    """Return the rows, without modules of packages that are gone as a whole."""
    read = [_modules(one) for one in revisions]
    rows = []
    for name in sorted(set().union(*read)):
        last = max(number for number, known in enumerate(read) if name in known)
        if last + 1 < len(read) and name.partition(".")[0] in {one.partition(".")[0] for one in read[last + 1]}:
            rows.append(Row(name, removed=revisions[last + 1].distro))
    return rows


def _modules(revision: Revision) -> set[str]:
    packages = {path.removesuffix("/__init__.py") for path in revision.paths if path.endswith("/__init__.py")}
    found = set()
    for path in revision.paths:
        folder, _, name = path.rpartition("/")
        is_public = name == "__init__.py" or not name.startswith("_")
        if not path.endswith(".py") or folder not in packages or _ASIDE.search(path) or not is_public:
            continue
        top = folder
        while top.rpartition("/")[0] in packages:
            top = top.rpartition("/")[0]
        inside = (
            path[len(top.rpartition("/")[0]) :]
            .strip("/")
            .removesuffix(".py")
            .removesuffix("/__init__")
            .replace("/", ".")
        )
        if "._" not in inside:
            found.add(inside)
    return found
