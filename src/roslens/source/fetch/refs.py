"""What a server calls a version: a branch, a tag or a commit."""

from __future__ import annotations

import re
from difflib import get_close_matches

import msgspec

from roslens.source.fetch.git_runner import GitError, GitRunner

_COMMIT = re.compile(r"[0-9a-f]{40}\Z")
_REF = re.compile(r"[\w][\w./+@-]*\Z")


class Ref(msgspec.Struct, frozen=True):
    """A name of the server and the commit or tag that it has now; ``name`` is empty for a bare commit."""

    name: str
    id: str


def is_commit(version: str) -> bool:
    """Return whether a version is the whole id of a commit."""
    return _COMMIT.match(version) is not None


def is_ref_name(version: str) -> bool:
    """Return whether a version can be the name of a branch or tag."""
    return _REF.match(version) is not None and ".." not in version and not version.endswith((".lock", "/"))


def is_unknown_ref(complaint: str) -> bool:
    """Return whether git complains that the server has no branch or tag of a name."""
    return "couldn't find remote ref" in complaint


def ref_of(git: GitRunner, folder: str, url: str, version: str) -> Ref:
    """Return what a version is called at the server.

    Raises:
        GitError: it has no such branch or tag, or is empty, or did not answer.
    """
    if is_commit(version):
        return Ref("", version)
    if version and not is_ref_name(version):
        raise GitError(f"{version!r} is not a valid name of a branch or tag")
    if not version:
        return _head(git, folder, url)
    branch, tag = f"refs/heads/{version}", f"refs/tags/{version}"
    found = _listed(git, folder, url, "--refs", branch, tag)
    for name in (branch, tag):
        if name in found:
            return Ref(name, found[name])
    everything = _listed(git, folder, url, "--refs", "--heads", "--tags")
    if not everything:
        raise GitError("the repository is empty: it has no branch")
    names = [name.split("/", 2)[2] for name in everything]
    near = get_close_matches(version, names, 3, 0.5) or [n for n in everything if n.startswith("refs/heads/")][:3]
    shown = ", ".join(name.removeprefix("refs/heads/") for name in near)
    raise GitError(f"there is no branch or tag {version!r}; the server has {shown or 'no similar one'}")


def _head(git: GitRunner, folder: str, url: str) -> Ref:
    reported = git.over_network(folder, "ls-remote", "--symref", url, "HEAD")
    name = id_ = ""
    for line in reported.splitlines():
        left, _, right = line.partition("\t")
        if right == "HEAD" and left.startswith("ref: "):
            name = left.removeprefix("ref: ")
        elif right == "HEAD":
            id_ = left
    if not id_:
        if _listed(git, folder, url, "--refs", "--heads"):
            raise GitError("the server shows no branch first; give a version")
        raise GitError("the repository is empty: it has no branch")
    return Ref(name, id_) if name.startswith("refs/heads/") else Ref("", id_)


def _listed(git: GitRunner, folder: str, url: str, *arguments: str) -> dict[str, str]:
    options = [one for one in arguments if one.startswith("-")]
    names = [one for one in arguments if not one.startswith("-")]
    reported = git.over_network(folder, "ls-remote", *options, url, *names)
    pairs = (line.split("\t", 1) for line in reported.splitlines() if "\t" in line)
    return {name: id_ for id_, name in pairs}
