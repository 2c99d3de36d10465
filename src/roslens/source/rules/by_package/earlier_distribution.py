"""Packages for an early distribution of ROS 2, as their files say: what a later one removed is a note there."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from posixpath import dirname

import msgspec

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.workspace.command_texts import command_texts

_RULE = "launch.unknown_keyword"
_EARLY = r"crystal|dashing|eloquent|foxy"
_NAMED = re.compile(rf"(?<![a-z])(?:{_EARLY})(?![a-z])", re.IGNORECASE)
_EARLY_IN_TEXT = re.compile(rf"\b(?:{_EARLY})\b".encode(), re.IGNORECASE)
_LATER_IN_TEXT = re.compile(rb"\b(?:galactic|humble|iron|jazzy|kilted|rolling)\b", re.IGNORECASE)
_IMAGE = "Dockerfile"


def as_notes_for_earlier_distribution(placed: Mapping[str, Sequence[Hit]], view: PackageView) -> dict[str, list[Hit]]:
    """Return hits by path; keywords that a later distribution removed are notes where a package is for an earlier one.

    A file says so by its name (``dashing_start.py``), a package by its texts and images, if they name early
    distributions and no later one.

    Args:
        placed: hits of rules in the files of a package.
        view: the package.
    """
    if not any(_is_removed(hit) for hits in placed.values() for hit in hits):
        return {path: list(hits) for path, hits in placed.items()}
    is_early = _is_for_an_early_one(view)
    return {
        path: [_note(hit) if _is_removed(hit) and (is_early or _NAMED.search(path)) else hit for hit in hits]
        for path, hits in placed.items()
    }


def _is_removed(hit: Hit) -> bool:
    return hit.rule == _RULE and hit.certainty is Certainty.LIKELY


def _note(hit: Hit) -> Hit:
    return msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC)


def _is_for_an_early_one(view: PackageView) -> bool:
    paths = command_texts(view.root, view.folder, (view.path(one) for one in view.listing))
    folders = [view.folder]
    while folders[-1]:
        folders.append(dirname(folders[-1]))
    images = [f"{folder}/{_IMAGE}" if folder else _IMAGE for folder in folders]
    texts = [view.read(path) for path in (*paths, *images)]
    return any(map(_EARLY_IN_TEXT.search, texts)) and not any(map(_LATER_IN_TEXT.search, texts))
