"""Rule ``python.undefined_name``: a name that nothing in the file defines."""

from __future__ import annotations

import builtins
import keyword
import re
from collections import Counter
from collections.abc import Iterator
from difflib import get_close_matches
from functools import cache

from tree_sitter import Language, Node, Query, QueryCursor

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule
from roslens.source.rules.views.launch_code import launch_code
from roslens.source.rules.views.python_names import above_of, python_names, text_of

_IS_SET = re.compile(rb"[ \t]*=(?!=)")
_CAUGHT = re.compile(rb"\bexcept\b[^\n:]*,[ \t]*(\w+)[ \t]*:")
"""How Python 2 names an exception."""
_KNOWN = (
    frozenset(one.encode() for one in (*dir(builtins), *keyword.kwlist, *keyword.softkwlist))
    | frozenset(
        (
            b"__file__",
            b"__name__",
            b"__doc__",
            b"__path__",
            b"__package__",
            b"__spec__",
            b"__loader__",
        )
    )
    | frozenset(
        (
            b"__builtins__",
            b"__class__",
            b"__annotations__",
            b"WindowsError",
            b"_",
            b"__qualname__",
            b"__module__",
        )
    )
    | frozenset(
        (
            b"get_ipython",
            b"display",
            b"reveal_type",
            b"profile",
            b"__IPYTHON__",
            b"__pyx_capi__",
        )
    )
)
_PYTHON2 = frozenset(
    (
        *(
            "unicode",
            "raw_input",
            "xrange",
            "basestring",
            "long",
            "unichr",
            "reduce",
            "reload",
            "file",
            "cmp",
        ),
        *(
            "execfile",
            "buffer",
            "apply",
            "intern",
            "coerce",
            "StandardError",
            "print",
            "exec",
        ),
    )
)
"""Builtins of Python 2, of which ``python.python2_name`` speaks."""
_IMPORTS = {
    "np": "import numpy as np", "plt": "import matplotlib.pyplot as plt", "pd": "import pandas as pd",
    "Node": "from rclpy.node import Node", "String": "from std_msgs.msg import String",
    "Twist": "from geometry_msgs.msg import Twist", "Image": "from sensor_msgs.msg import Image",
    "LaserScan": "from sensor_msgs.msg import LaserScan", "Odometry": "from nav_msgs.msg import Odometry",
    "PoseStamped": "from geometry_msgs.msg import PoseStamped", "CvBridge": "from cv_bridge import CvBridge",
    "Duration": "from rclpy.duration import Duration", "QoSProfile": "from rclpy.qos import QoSProfile",
    "partial": "from functools import partial", "deque": "from collections import deque",
    "Path": "from pathlib import Path", "sleep": "from time import sleep",
}  # fmt: skip
_MODULES = frozenset(
    (
        *(
            "rclpy",
            "rospy",
            "os",
            "sys",
            "time",
            "math",
            "json",
            "yaml",
            "threading",
            "subprocess",
            "random",
            "copy",
        ),
        *(
            "cv2",
            "re",
            "datetime",
            "traceback",
            "logging",
            "struct",
            "socket",
            "signal",
            "argparse",
            "collections",
        ),
        *(
            "tf2_ros",
            "functools",
            "itertools",
            "queue",
            "pathlib",
            "shutil",
            "serial",
            "torch",
            "numpy",
            "rosbag",
        ),
    )
)
_WAYS = (
    "if_statement",
    "while_statement",
    "for_statement",
    "try_statement",
    "except_clause",
    "conditional_expression",
)
_VERSIONS = (b"version", b"PY2", b"PY3", b"TYPE_CHECKING")
_FUNCTIONS = ("function_definition", "lambda")


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield the first use of each name that nothing binds."""
    if not _may_be_unbound(view) or launch_code(view) is not None:
        return
    unbound = [one for one in python_names(view).unbound() if _is_told(one, view)]
    uses = Counter(map(text_of, unbound))
    said: set[str] = set()
    for node in unbound:
        name = text_of(node)
        if name in said:
            continue
        said.add(name)
        more = f", here and {uses[name] - 1} times more" if uses[name] > 1 else ""
        message = f"`{name}` is not defined: a NameError where it is read{more}; expected {_expected(name, view)}"
        certainty = None if above_of(node, *_WAYS, *_FUNCTIONS) is None else Certainty.LIKELY
        yield view.hit("python.undefined_name", node, message, certainty=certainty)


def _may_be_unbound(view: FileView) -> bool:
    """Tell whether some name is read that no form of binding in the file names.

    To go through the names of each file, scope by scope, would cost more than all other rules on it. A name behind a
    point is an attribute, one before `=` is set or that of an argument.
    """
    captured = QueryCursor(_query()).captures(view.root)
    source = view.source
    names = {
        source[one.start_byte : one.end_byte]
        for one in captured.get("any", ())
        if source[one.start_byte - 1 : one.start_byte] != b"." and not _IS_SET.match(source, one.end_byte)
    }
    names -= _KNOWN
    # `from rclpy.node import Node` binds Node, not rclpy.
    modules = {one.start_byte for one in captured.get("module", ())}
    bound = (one for one in captured.get("bound", ()) if one.start_byte not in modules)
    names.difference_update(source[one.start_byte : one.end_byte] for one in bound)
    return bool(names)


@cache
def _query() -> Query:
    import tree_sitter_python

    holders = (
        "parameters",
        "lambda_parameters",
        "typed_parameter",
        "pattern_list",
        "tuple_pattern",
        "list_pattern",
    )
    more = (
        "list_splat_pattern",
        "dictionary_splat_pattern",
        "as_pattern_target",
        "global_statement",
        "dotted_name",
    )
    fields = (
        *((one, "left") for one in ("assignment", "for_statement", "for_in_clause")),
        *((one, "name") for one in ("function_definition", "class_definition", "default_parameter")),
        *((one, "name") for one in ("typed_default_parameter", "named_expression")),
        ("aliased_import", "alias"),
    )
    patterns = [f"({one} (identifier) @bound)" for one in (*holders, *more, "nonlocal_statement")]
    patterns += [f"({kind} {field}: (identifier) @bound)" for kind, field in fields]
    patterns.append("(import_from_statement module_name: (dotted_name (identifier) @module))")
    found: Query = Query(
        Language(tree_sitter_python.language()),
        "\n".join((*patterns, "(identifier) @any")),
    )
    return found


def _is_told(node: Node, view: FileView) -> bool:
    name = text_of(node)
    known = name.encode()
    if known in _KNOWN or name in _PYTHON2 or known in view.names(_CAUGHT):
        return False
    return not _is_of_python2(node, view)


def _is_of_python2(node: Node, view: FileView) -> bool:
    """Tell whether a condition on the version of Python is around a node."""
    if not view.mentions(_VERSIONS):
        return False
    around = above_of(node, "if_statement", "conditional_expression")
    while around is not None:
        text = view.text(around)[:200]
        if any(one.decode() in text for one in _VERSIONS):
            return True
        around = above_of(around, "if_statement", "conditional_expression")
    return False


def _expected(name: str, view: FileView) -> str:
    if name in _IMPORTS:
        return f"`{_IMPORTS[name]}`"
    if name in _MODULES:
        return f"`import {name}`"
    known = {one.decode("utf-8", "replace") for one in view.words} - {name}
    if re.search(rb"\bself\s*\.\s*" + re.escape(name.encode()) + rb"\b", view.code):
        return f"`self.{name}`, or its definition"
    close = get_close_matches(name, sorted(known), 1, 0.8)
    return f"`{close[0]}`, or its definition" if close else "its import or definition"


RULE = FileRule(
    id="python.undefined_name",
    title="Name that is not defined (Python)",
    finds="A name that the file neither imports nor binds anywhere, and that is no builtin: a forgotten import, a "
    "typing error, a forgotten `self.`. Files with `import *`, `exec` or `globals()` are left out, and names in a "
    "`try` that catches the NameError.",
    why="Python raises a NameError when the line is reached: at the start, or at the first message that takes this "
    "way.",
    consequence=Consequence.WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=(),
    clauses=("ruff F821", "pyflakes undefined-name"),
    syntax="python",
    whole=True,
    bad="def report(node, value):\n    node.get_logger().info(str(math.floor(value)))\n",
    good="import math\n\n\ndef report(node, value):\n    node.get_logger().info(str(math.floor(value)))\n",
    found=found,
)
