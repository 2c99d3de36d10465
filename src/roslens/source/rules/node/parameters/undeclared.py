"""Whether a file declares any parameter, for the rules about parameters that are read and never declared."""

from __future__ import annotations

import re

from roslens.source.rules.file_view import FileView

_DECLARES = re.compile(rb"declare|allow_undeclared|ParamListener|ParametersClient|add_parameters?\b")
"""Any declaration, a helper called so, code made by generate_parameter_library, and clients of other nodes."""
ALWAYS_THERE = ("use_sim_time", "qos_overrides.", "start_type_description_service")
"""Beginnings of names that every node declares itself."""


def declares_nothing(view: FileView) -> bool:
    """Return whether no parameter is declared in a file, by whatever means."""
    return _DECLARES.search(view.code) is None


def is_always_there(name: str) -> bool:
    """Return whether a parameter, as written, is one that every node has."""
    return name.lstrip("fru").strip("'\"").startswith(ALWAYS_THERE)
