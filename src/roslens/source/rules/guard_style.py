"""How the guard of a header is named: by the guide of ROS 2, of ROS 1, or of Google."""

from __future__ import annotations

import re
from collections.abc import Collection

ROS2, ROS1, GOOGLE = "ros2", "ros1", "google"

_ROOTS = ("include", "src")
"""Folders of a package that no guard names."""


def guard_style(profiles: Collection[str], ros: Collection[int]) -> str:
    """Return whose guide names guards: Google's where its profile was asked for, else that of the package's ROS.

    Args:
        profiles: that the user chose, by name.
        ros: the versions of ROS that the package is built for.
    """
    if GOOGLE in profiles:
        return GOOGLE
    return ROS2 if 2 in ros else ROS1


def guard_name(inside: str, package: str, style: str) -> str:
    """Return the name of the guard of a header.

    ``PACKAGE__FOLDER__FILE_HPP_`` in ROS 2, as ament_cpplint has it; ``PACKAGE_FOLDER_FILE_H`` in ROS 1;
    ``PACKAGE_FOLDER_FILE_H_`` by Google.

    Args:
        inside: path of the header below its package.
        package: name of the package.
        style: see :func:`guard_style`.
    """
    parts = inside.split("/")
    if len(parts) > 1 and parts[0] in _ROOTS:
        parts = parts[1:]
    # Headers of packages that are overlaid are in include/package/package.
    while len(parts) > 1 and parts[0] == package:
        parts = parts[1:]
    separator = "__" if style == ROS2 else "_"
    name = separator.join(re.sub(r"\W", "_", part, flags=re.ASCII) for part in (package, *parts)).upper()
    name = name if name[:1].isalpha() else f"H_{name}"
    return name if style == ROS1 else f"{name}_"
