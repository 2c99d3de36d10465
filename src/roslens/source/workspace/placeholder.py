"""What a template leaves open in a text: a release, a build or a generator writes something else in its place."""

from __future__ import annotations

import re

_PLACEHOLDER = re.compile(
    r"\{\{|\{%|\[\["  # {{ version }}, {% for one in dependencies %} of Jinja; [[ version ]]
    r"|\$\{|\$\("  # ${VERSION} of CMake, shells and Maven; $(VERSION) of make
    r"|\$[A-Z_]{2,}\b"  # $VERSION of envsubst
    r"|\{[A-Za-z_][\w.:]*\}"  # {version} of Python, :{version} of bloom
    r"|(?<![\w.%+-])@[A-Za-z_]\w*@"  # @VERSION@ of configure_file
    r"|@[(\[{]"  # @(version), @[for one in dependencies] of empy
    r"|%\(\w+\)s|%[A-Za-z_]\w*%"  # %(version)s, %VERSION%
    r"|\b__\w+__\b"  # __VERSION__ of sed
)


def has_placeholder(text: str) -> bool:
    """Return whether a text holds what a template leaves open: ``@VERSION@``, ``{{ version }}``, ``:{version}``."""
    return _PLACEHOLDER.search(text) is not None
