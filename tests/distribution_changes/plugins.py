"""Names by which plug-ins are loaded, and their parameters, that a distribution has and the next one has not."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

import yaml

from distribution_changes.revision import Revision
from distribution_changes.row import Row

_CLASS = re.compile(r"<class\b([^>]*)>", re.DOTALL)
_ATTRIBUTE = re.compile(r"([\w:]+)\s*=\s*[\"']([^\"']*)[\"']")
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)


def plugin_rows(revisions: Sequence[Revision]) -> list[Row]:
    """Return the rows: a name that another one of the same class takes the place of, or none."""
    read = [_plugins(one) for one in revisions]
    rows = []
    for name in sorted(set().union(*read)):
        last = max(number for number, known in enumerate(read) if name in known)
        if last + 1 == len(read):
            continue
        after = {type_: other for other, (type_, _) in read[last + 1].items()}
        instead = after.get(read[last][name][0], "")
        newest = instead if instead in read[-1] else ""
        rows.append(Row(name, removed=revisions[last + 1].distro, instead=newest, alike=bool(newest)))
    return rows


def parameter_rows(revisions: Sequence[Revision]) -> list[Row]:
    """Return the rows for packages with one plug-in whose parameters a library is generated from."""
    read = [_parameters(one) for one in revisions]
    rows = []
    for owner in sorted(set().union(*read)):
        for name in sorted(set().union(*(known.get(owner, ()) for known in read))):
            last = max(number for number, known in enumerate(read) if name in known.get(owner, ()))
            if last + 1 < len(read) and owner in read[last + 1]:
                rows.append(Row(f"{owner}:{name}", removed=revisions[last + 1].distro))
    return rows


def _plugins(revision: Revision) -> Mapping[str, tuple[str, str]]:
    """Return the type and the file of each plug-in, by the name that loads it."""
    paths = [
        path
        for path in revision.paths
        if path.endswith(".xml") and not path.endswith("package.xml") and not re.search(r"(?:^|/)tests?/", path)
    ]
    found = {}
    for path, text in revision.read(paths).items():
        if "<library" not in text or "base_class_type" not in text:
            continue
        for match in _CLASS.finditer(_COMMENT.sub("", text)):
            attributes = dict(_ATTRIBUTE.findall(match[1]))
            if "base_class_type" in attributes and "type" in attributes:
                found[attributes.get("name", attributes["type"])] = (attributes["type"], path)
    return found


def _parameters(revision: Revision) -> Mapping[str, set[str]]:
    """Return the parameters of plug-ins that are alone in their package, by the name that loads them."""
    packages = [path.removesuffix("package.xml") for path in revision.paths if path.endswith("package.xml")]
    plugins = _plugins(revision)
    found: dict[str, set[str]] = {}
    for package in packages:
        own = [name for name, (_, path) in plugins.items() if path.startswith(package)]
        files = [
            path
            for path in revision.paths
            if path.startswith(package) and re.search(r"parameters?\.ya?ml$", path) and "/test/" not in path
        ]
        if len(own) != 1 or not files:
            continue
        names = {name for text in revision.read(files).values() for name in _names(text)}
        if names:
            found[own[0]] = names
    return found


def _names(text: str) -> Iterator[str]:
    try:
        document = yaml.safe_load(text)
    except yaml.YAMLError:
        return
    if isinstance(document, dict) and len(document) == 1:
        (inside,) = document.values()
        yield from _below(inside, "")


def _below(table: object, prefix: str) -> Iterator[str]:
    if not isinstance(table, dict):
        return
    for name, value in table.items():
        if isinstance(value, dict) and isinstance(value.get("type"), str):
            yield f"{prefix}{name}"
        elif isinstance(value, dict) and not str(name).startswith("__"):
            yield from _below(value, f"{prefix}{name}.")
