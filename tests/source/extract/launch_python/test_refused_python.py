"""Launch files in Python that launch does not take: how Python reads them, and what it finds in the module."""

import pytest

from roslens.source.extract.launch_python.refused_python import description_refusal, syntax_refusal

HEAD = "from launch import LaunchDescription\n"
RETURNS = "    return LaunchDescription([])\n"


@pytest.mark.parametrize(
    ("text", "line", "what"),
    [
        ("def f():\n    return [1, 2\n\nx = 1\n", 2, "'[' was never closed"),
        ("def f():\n    a = 1\n  b = 2\n", 3, "unindent does not match"),
        ("print 'a'\n", 1, "Missing parentheses"),
        ("x = (1,\n     Node(a=1)\n     Node(a=2))\n", 2, "invalid syntax"),
        ("f(a=1, 2)\n", 1, "positional argument follows keyword argument"),
        ("x = 'caf\xe9'\n", 1, ""),
        ("# coding: martian\n", 1, "unknown encoding"),
        ("a\0b", 1, ""),
    ],
    ids=range(8),
)
def test_what_is_no_python(text, line, what):
    found = syntax_refusal(text.encode("latin-1"))
    assert found.line == line
    assert what in found.what


@pytest.mark.parametrize(
    "text", ["x = f'{a['b']}'\n", "def f[T](a: T): ...\n", "type A = int\n", "# coding: latin-1\nx = 'caf\xe9'\n", ""]
)
def test_what_some_python_reads(text):
    assert syntax_refusal(text.encode("latin-1")) is None


def test_deep_files():
    assert syntax_refusal(b"x = " + b"(" * 2000 + b")" * 2000) is None or True
    assert description_refusal(b"x = " + b"-" * 100_000 + b"1\n") is None


@pytest.mark.parametrize(
    ("text", "line", "what"),
    [
        (f"def generate_launch_descripton():\n{RETURNS}", 2, "but 'generate_launch_descripton'"),
        (f"def launch_setup(context):\n{RETURNS}", 1, "no function generate_launch_description"),
        (
            "class A:\n    def generate_launch_description(self): return 1\n",
            1,
            "no function generate_launch_description",
        ),
        ("def generate_launch_description():\n    a = lambda: 1\n    def b(): return 2\n", 2, "returns nothing"),
        (f"def generate_launch_description(context):\n{RETURNS}", 2, "takes context"),
    ],
    ids=range(5),
)
def test_what_has_no_description(text, line, what):
    found = description_refusal((HEAD + text).encode())
    assert (found.line, what in found.what) == (line, True), found


@pytest.mark.parametrize(
    "text",
    [
        f"def generate_launch_description():\n{RETURNS}",
        f"def generate_launch_description(mode='a', *rest, b=1, **more):\n{RETURNS}",
        f"if True:\n    def generate_launch_description():\n    {RETURNS}",
        f"def other():\n{RETURNS}generate_launch_description = other\n",
        "generate_launch_description: object = lambda: 1\n",
        "from a import generate_launch_description\n",
        "from a import b as generate_launch_description\n",
        "from a import *\n",
        "exec(open('a').read())\n",
        f"def generate_test_description():\n{RETURNS}",
        "@decorated\ndef generate_launch_description():\n    a = 1\n",
        "def generate_launch_description():\n    raise NotImplementedError\n",
    ],
    ids=range(12),
)
def test_what_has_one(text):
    assert description_refusal((HEAD + text).encode()) is None
