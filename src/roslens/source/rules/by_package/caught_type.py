"""What is known of exceptions only where all sources of a package are: who catches them, and who derives from them."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence

import msgspec

from roslens.model.source import Language, Role
from roslens.model.weight.consequence import Certainty
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView

_POINTER, _AGAIN = "cpp.throw_pointer", "cpp.rethrow_by_name"
_THROWN = re.compile(r"throw\s+new\s+([\w:]+)")
_CAUGHT = re.compile(rb"\bcatch\s*\(\s*(?:const\s+)?([\w:]+)\s*(?:const\s*)?\*")
_NAMED = re.compile(r"throw\s+(\w+)")
_HANDLED = re.compile(rb"\bcatch\s*\(\s*(?:const\s+)?([\w:]+)[\w\s&]*?\b(\w+)\s*\)")
_BASES = re.compile(rb"\b(?:class|struct)\s+(?:\w+\s+)*?(\w+)\s*(?:final\s*)?(:[^:][^{;]*)?\{")
_LEAVES = frozenset(
    (
        b"rclcpp::ParameterTypeException",
        b"rclcpp::exceptions::InvalidParameterTypeException",
        b"rclcpp::exceptions::InvalidParameterValueException",
        b"rclcpp::exceptions::ParameterAlreadyDeclaredException",
        b"rclcpp::exceptions::ParameterNotDeclaredException",
        b"tf2::ConnectivityException",
        b"tf2::LookupException",
        b"tf2::TimeoutException",
    )
)
"""Types of ROS from which nothing of ROS derives."""
_ALL_OF_STD = b"std::exception"


def as_notes_of_caught_types(placed: Mapping[str, Sequence[Hit]], view: PackageView) -> dict[str, list[Hit]]:
    """Return hits by path; some that nothing comes of in the package are notes.

    These are a pointer that is thrown where a handler of the package catches pointers of that type, and an exception
    that is thrown again as a copy where its type is one of the package, or of ROS, from which nothing derives.

    Args:
        placed: hits of rules in the files of a package.
        view: the package.
    """
    spared: Mapping[str, Callable[[Hit, str], bool]] = {
        rule: make(view)
        for rule, make in _MAKERS.items()
        if any(hit.rule == rule for hits in placed.values() for hit in hits)
    }
    return {path: [_judged(hit, path, spared) for hit in hits] for path, hits in placed.items()}


def _judged(hit: Hit, path: str, spared: Mapping[str, Callable[[Hit, str], bool]]) -> Hit:
    if hit.rule in spared and spared[hit.rule](hit, path):
        return msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC)
    return hit


def _sources(view: PackageView) -> Iterator[bytes]:
    for file in view.of_language(Language.C, Language.CPP, roles=(Role.OWN, Role.TEST, Role.VENDORED)):
        yield view.read(file.path)


def _caught_as_pointer(view: PackageView) -> Callable[[Hit, str], bool]:
    caught = {match[1] for text in _sources(view) for match in _CAUGHT.finditer(text)}

    def is_caught(hit: Hit, _path: str) -> bool:
        thrown = _THROWN.match(hit.context)
        if thrown is None:
            return False
        name = thrown[1].encode()
        of_std = name.startswith(b"std::") and name.endswith(b"_error") and _ALL_OF_STD in caught
        return of_std or _last(name) in map(_last, caught)

    return is_caught


def _has_no_derived(view: PackageView) -> Callable[[Hit, str], bool]:
    own: set[bytes] = set()
    bases: set[bytes] = set()
    for text in _sources(view):
        for match in _BASES.finditer(text):
            own.add(match[1])
            bases.update(re.findall(rb"\w+", match[2] or b""))
    leaves = own - bases

    def is_leaf(hit: Hit, path: str) -> bool:
        copied = _copied(hit, view.read(path))
        return copied in _LEAVES or _last(copied) in leaves

    return is_leaf


def _copied(hit: Hit, text: bytes) -> bytes:
    """Return the type that the handler around a ``throw`` catches; empty where that is not seen."""
    named = _NAMED.match(hit.context)
    before = b"\n".join(text.splitlines()[: hit.line])
    caught = [match[1] for match in _HANDLED.finditer(before) if named is not None and match[2].decode() == named[1]]
    return caught[-1] if caught else b""


def _last(name: bytes) -> bytes:
    return name.rpartition(b":")[2]


_MAKERS: Mapping[str, Callable[[PackageView], Callable[[Hit, str], bool]]] = {
    _POINTER: _caught_as_pointer,
    _AGAIN: _has_no_derived,
}
