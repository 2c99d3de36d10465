"""How many issues and requests a repository has, open and closed: pull and merge requests are no issues."""

from __future__ import annotations

from urllib.parse import quote, urlencode

import msgspec

from roslens.source.forge.forge_client import ForgeClient, Reported
from roslens.source.forge.forge_error import ForgeError
from roslens.source.forge.forge_place import ForgeKind, ForgePlace

MOST_PAGES = 200
_PAGE = 50


class IssueCounts(msgspec.Struct, frozen=True):
    """Numbers of issues and of pull or merge requests; merged ones are closed."""

    open_issues: int
    closed_issues: int
    open_requests: int
    closed_requests: int

    def values(self) -> dict[str, float]:
        """Return them by the keys of their quantities."""
        return {key: float(value) for key, value in msgspec.structs.asdict(self).items()}


def issue_counts(client: ForgeClient, place: ForgePlace) -> IssueCounts:
    """Ask a forge.

    Raises:
        ForgeError: it does not tell.
    """
    ask = {ForgeKind.GITHUB: _github, ForgeKind.GITLAB: _gitlab, ForgeKind.GITEA: _gitea}[place.forge.kind]
    return ask(client, place.name)


def _github(client: ForgeClient, name: str) -> IssueCounts:
    # The search counts without listing; lists of issues hold pull requests too.
    found = []
    for what in ("issue", "pr"):
        for state in ("open", "closed"):
            query = urlencode({"q": f"repo:{name} type:{what} state:{state}", "per_page": "1"})
            reported = client.get(f"/search/issues?{query}")
            if isinstance(reported.document, dict) and reported.document.get("incomplete_results") is True:
                raise ForgeError("the search of GitHub ended before it was complete", "Try again later")
            found.append(_count(reported, "total_count"))
    return IssueCounts(*found)


def _gitlab(client: ForgeClient, name: str) -> IssueCounts:
    project = f"/projects/{quote(name, safe='')}"
    reported = client.get(f"{project}/issues_statistics")
    counts = _inside(reported, "statistics", "counts")
    issues = (_whole(counts, "opened"), _whole(counts, "closed"))
    requests = {
        state: _listed(client, f"{project}/merge_requests?state={state}", "x-total", "per_page")
        for state in ("opened", "closed", "locked", "merged")
    }
    open_requests = requests.pop("opened")
    return IssueCounts(*issues, open_requests, sum(requests.values()))


def _gitea(client: ForgeClient, name: str) -> IssueCounts:
    found = [
        _listed(client, f"/repos/{quote(name)}/issues?state={state}&type={what}", "x-total-count", "limit")
        for what in ("issues", "pulls")
        for state in ("open", "closed")
    ]
    return IssueCounts(*found)


def _listed(client: ForgeClient, path: str, header: str, size: str) -> int:
    """Return the length of a list: from a header, else from its pages."""
    number = 0
    for page in range(1, MOST_PAGES + 1):
        reported = client.get(f"{path}&{size}={_PAGE}&page={page}")
        if not isinstance(reported.document, list):
            raise ForgeError(f"{path} does not answer with a list", "Is it a forge of this kind?")
        if (total := reported.headers.get(header, "")).isdigit():
            return int(total)
        number += len(reported.document)
        if len(reported.document) < _PAGE:
            return number
    raise ForgeError(f"{path} has more than {MOST_PAGES * _PAGE:,} entries and does not state their number")


def _count(reported: Reported, key: str) -> int:
    return _whole(reported.document if isinstance(reported.document, dict) else {}, key)


def _inside(reported: Reported, *keys: str) -> dict[str, object]:
    found = reported.document
    for key in keys:
        found = found.get(key) if isinstance(found, dict) else None
    return found if isinstance(found, dict) else {}


def _whole(counts: dict[str, object], key: str) -> int:
    value = counts.get(key)
    if not isinstance(value, int) or isinstance(value, bool) or value < 0:
        raise ForgeError(f'the answer has no number "{key}"', "Is it a forge of this kind?")
    return value
