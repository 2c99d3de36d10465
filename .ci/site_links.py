"""Links from docs/ to other files of the repository, for the site, which has no pages of those.

A link to a file that is there becomes its path as text, a picture that was not made its title; a link to one that is
not there stays, and MkDocs reports it.
"""

from __future__ import annotations

import re
from pathlib import Path, PurePosixPath
from posixpath import normpath
from typing import Any

LINK = re.compile(r"(!?)\[([^\]]*)\]\(((?:\.\./)+[^)#\s]+)(?:#[^)\s]*)?\)")


def on_page_markdown(markdown: str, *, page: Any, config: Any, **_: Any) -> str:
    """Return the text of a page in which no link leaves docs/."""
    docs = Path(config["docs_dir"])
    folder = PurePosixPath(page.file.src_uri).parent

    def shown(link: re.Match[str]) -> str:
        picture, text, target = link.groups()
        path = normpath(str(PurePosixPath("docs") / folder / target))
        if path.startswith("docs/"):
            return link[0]
        if picture:
            return f"*{text}: `make tour` takes this picture.*"
        if not (docs.parent / path).exists():
            return link[0]
        return text if path in text else f"{text} (`{path}`)"

    return LINK.sub(shown, markdown)
