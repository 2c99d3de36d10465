"""Rule ``cpp.c_header``: a header of C."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from tree_sitter import Node

from roslens.model.edit import Edit
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_HEADER = re.compile(
    rb"#[ \t]*include[ \t]*<((?:assert|ctype|errno|fenv|float|inttypes|limits|locale|math|setjmp|signal|stdarg"
    rb"|stddef|stdint|stdio|stdlib|string|time|wchar|wctype|complex|stdbool)\.h)>"
)


_UNLIKE = frozenset({"math.h", "stdlib.h", "complex.h", "stdbool.h", "fenv.h"})
"""Headers whose other form has other overloads of the same names, such as `abs`, or is gone in C++20."""


def found_among(nodes: Sequence[Node], view: FileView) -> Iterator[Hit]:
    """Yield each include of a header that C++ has under another name."""
    for node in nodes:
        match = _HEADER.match(view.source, node.start_byte, node.end_byte)
        if match:
            name = match[1].decode()
            instead = f"c{name.removesuffix('.h')}"
            edits: tuple[Edit, ...] = ()
            if name not in _UNLIKE and view.is_cpp_alone:
                edits = view.edits((match.start(1), match.end(1), instead))
            message = f"`<{name}>`; expected `<{instead}>`"
            yield view.hit_at("cpp.c_header", view.place(node.start_byte)[0], message, edits=edits)


RULE = FileRule(
    id="cpp.c_header",
    title="Header of C",
    finds="`<math.h>` and other headers of the C library. Include `<cmath>` and its like.",
    why="`abs` of a `double` may be the one of integers.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "misra-cpp-2008",
        "autosar-cpp14",
        "paper2016",
    ),
    clauses=(
        "misra-cpp-2008 18-0-1",
        "autosar-cpp14 A18-0-1",
        "paper2016 c_headers",
        "clang-tidy modernize-deprecated-headers",
    ),
    fix="Names the header of C++, but not for `<math.h>` and `<stdlib.h>`: there `abs` may become another function.",
    bad="#include <math.h>\n",
    good="#include <cmath>\n",
    syntax="cpp",
    kinds=("preproc_include",),
    in_c=False,
    found_among=found_among,
)
