"""Which class is meant where a type's name is used."""

from __future__ import annotations

import re
from collections.abc import Iterable

from roslens.source.metrics.class_model.class_names import ClassNames
from roslens.source.metrics.class_model.language_library import in_cpp_library, in_python_library
from roslens.source.syntax.python_names import is_class_like

_PARTS_OF_INTERFACES = frozenset({"Request", "Response", "Goal", "Result", "Feedback"})
"""Names inside a service or action of ROS."""

_ALIAS_WORDS = (
    "Ptr ConstPtr SharedPtr ConstSharedPtr UniquePtr WeakPtr ConstWeakPtr iterator const_iterator reverse_iterator "
    "value_type size_type key_type mapped_type reference const_reference type"
)
_NESTED_ALIASES = _PARTS_OF_INTERFACES.union(_ALIAS_WORDS.split())
"""Names inside a class that stand for it."""

_POINTER_ENDINGS = ("ConstPtr", "WPtr", "Ptr")

_CLASS_OUTSIDE = re.compile(r"[A-Z]\w*[a-z]\w*(?<!T)")
"""A name without scope that no class of the package has: most in capitals are constants, those in small letters
aliases, those that end in T parameters of templates."""


def used_classes(names: Iterable[str], scope: str, known: ClassNames, syntax: str) -> set[str]:
    """Return the classes that ``names`` mean inside ``scope``.

    Classes of the package appear under their full name; others as written, but without the aliases
    that stand for them (``nav_msgs::Odometry::ConstPtr`` and ``nav_msgs::OdometryConstPtr`` are
    ``nav_msgs::Odometry``), and once where they are written with and without their scope. What
    belongs to the language's own library is left out; of C++ also what is written without scope, is no
    class of the package and looks like an alias, a constant or a parameter of a template.
    """
    meaning = _cpp_class if syntax == "cpp" else _python_class
    separator = "::" if syntax == "cpp" else "."
    found = {one for name in names if (one := meaning(name, scope, known))}
    scoped = {name.rpartition(separator)[2] for name in found if separator in name}
    return {name for name in found if separator in name or name not in scoped}


def called_classes(calls: Iterable[str], scope: str, known: ClassNames, syntax: str) -> set[str]:
    """Return the classes, as written, on which ``calls`` call static functions: ``Clock`` of ``Clock::now``.

    What stands before a call may be a namespace or module: of what the package does not have, only names that look
    like classes are taken, in C++ those with a scope before them (``ros::Time``, but not ``Eigen``).
    """
    separator = "::" if syntax == "cpp" else "."
    found = set()
    for call in calls:
        holder = call.rpartition(separator)[0]
        if holder and (known.find(holder, scope) or _looks_like_class(holder, syntax)):
            found.add(holder)
    return found


def _looks_like_class(holder: str, syntax: str) -> bool:
    if syntax == "python":
        return is_class_like(holder)
    first, _, last = holder.rpartition("::")
    return bool(first) and _CLASS_OUTSIDE.fullmatch(last) is not None


def _cpp_class(written: str, scope: str, known: ClassNames) -> str | None:
    name = written.removeprefix("::")
    scope = scope if name == written else ""
    found = known.find(name, scope)
    if found or in_cpp_library(name):
        return found
    first, _, last = name.rpartition("::")
    while last in _NESTED_ALIASES or last.endswith("_t"):
        if not first:
            return None
        name = first
        first, _, last = name.rpartition("::")
    pointed_to = _without_pointer(name)
    found = known.find(name, scope) or known.find(pointed_to, scope) or _holder(first, scope, known)
    if found:
        return found
    if first:
        return pointed_to
    return name if _CLASS_OUTSIDE.fullmatch(name) and pointed_to == name else None


def _without_pointer(name: str) -> str:
    for ending in _POINTER_ENDINGS:
        if name.endswith(ending) and not name.endswith("::" + ending):
            return name.removesuffix(ending)
    return name


def _holder(name: str, scope: str, known: ClassNames) -> str | None:
    """Return the class of the package that an enumeration or alias inside it is named by."""
    while name:
        found = known.find(name, scope)
        if found:
            return found
        name = name.rpartition("::")[0]
    return None


def _python_class(name: str, scope: str, known: ClassNames) -> str | None:
    found = known.find(name, scope)
    if not found:
        first, _, last = name.rpartition(".")
        if first and last in _PARTS_OF_INTERFACES:
            name = first
            found = known.find(name, scope)
    return found or (None if in_python_library(name) else name)
