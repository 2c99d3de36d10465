"""Links of the documentation lead somewhere, and every page can be found from the start page of its site."""

import re
from pathlib import Path

import yaml

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
LINK = re.compile(r"(?<!!)\[[^\]]*\]\(([^)\s]+)\)")
PAGES = sorted([*ROOT.glob("*.md"), *DOCS.rglob("*.md")])
GENERATED = {DOCS / "reference" / name for name in ("rules", "tools", "actions", "metrics")}
"""Folders whose pages are listed by a page of their own."""


def targets(page: Path, text: str) -> list[str]:
    """Return what the links of a page lead to below the repository, without those that lead out of it."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL)
    text = re.sub(r"^(?: {4}|\t).*$", "", text, flags=re.MULTILINE)
    text = re.sub(r"`[^`\n]*`", "", text)
    return [link.partition("#")[0] for link in LINK.findall(text) if not re.match(r"[a-z]+:|#", link)]


def missing(page: Path, text: str) -> list[str]:
    return [target for target in targets(page, text) if not (page.parent / target).exists()]


def test_links_lead_to_files():
    assert len(PAGES) > 300
    nowhere = {page: targets for page in PAGES if (targets := missing(page, page.read_text("utf-8")))}
    assert nowhere == {}


def test_a_link_to_nowhere_is_seen():
    text = "[one](README.md), [two](nowhere.md#part), `[three](code.md)`, [four](https://a.org)\n\n    [five](x)\n"
    assert missing(ROOT / "CONTRIBUTING.md", text) == ["nowhere.md"]


def test_every_page_is_in_the_navigation():
    def named(part) -> set[str]:
        if isinstance(part, str):
            return {part}
        return {name for one in (part.values() if isinstance(part, dict) else part) for name in named(one)}

    found = named(yaml.safe_load((ROOT / "mkdocs.yml").read_text("utf-8"))["nav"])
    written = {page for page in PAGES if page.is_relative_to(DOCS) and page.parent not in GENERATED}
    assert {page.relative_to(DOCS).as_posix() for page in written} - found == set()
    assert [name for name in found if not (DOCS / name).is_file()] == []
