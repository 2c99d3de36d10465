"""No rule takes more than its share of a large file: four times the file takes about four times as long.

Files are generated: tables as firmware and robot models have them, one long function and one large class, and the good
examples of all rules again and again. What a rule finds does not count, as rules stop at so many findings of one file.
"""

import re
import time
from functools import cache

import pytest

from roslens.model.source import Language
from roslens.source.parsed_file import parse_file
from roslens.source.rules.match_file import kinds_asked, match_file
from roslens.source.rules.table import file_rules
from roslens.source.settings import MacroSettings

GROWTH = 4
SLACK = 2.2
"""A quadratic rule takes four times as long as a linear one for the larger file."""
LEAST_S = 0.06
"""What takes less for the larger file is not judged: a quadratic share of it is not measurable, and hurts nobody."""


def tables(size):
    rows = ", ".join("{1.0f, 2.0f, 0x3}" for _ in range(4))
    return "".join(
        f"static const float TABLE_{n}[4][3] = {{{rows}}};\n"
        f'const char* const NAME_{n}[] = {{"a{n}", "b"}};\n'
        f"uint8_t buffer_{n}[SIZE_{n}];\n#define SIZE_{n} {n}\n"
        for n in range(size)
    )


def one_table(size):
    return "const int ALL[] = {\n" + "".join(f'  {n}, -{n}, A({n}), B | C, "x",\n' for n in range(size)) + "};\n"


def long_function(size):
    lines = "".join(
        f'  int v{n} = f(v, {n});\n  if (v{n} > limit) {{ g(v{n}); }} else {{ h.call(v{n}, "t"); }}\n'
        f"  double a{n}[8]; for (int i = 0; i < 8; ++i) {{ a{n}[i] = v{n} * 0.5; }}\n"
        for n in range(size)
    )
    return f"#include <rclcpp/rclcpp.hpp>\nint run(int v, int limit) {{\n{lines}  return v;\n}}\n"


def large_class(size):
    members = "".join(
        f"  void set_{n}(int value) {{ member_{n}_ = value; }}\n  int get_{n}() const {{ return member_{n}_; }}\n"
        f"  int member_{n}_ = 0;\n  rclcpp::Publisher<M>::SharedPtr pub_{n}_;\n"
        for n in range(size)
    )
    return f"#include <rclcpp/rclcpp.hpp>\nclass Large : public rclcpp::Node {{\npublic:\n{members}}};\n"


def branches(size):
    cases = "".join(f"    case {n}: return {n + 1};\n" for n in range(size))
    return f"int next(int state) {{\n  switch (state) {{\n{cases}    default: return 0;\n  }}\n}}\n"


def good_cpp(size):
    return _again([rule.good for rule in file_rules("cpp")], max(1, size // 250))


def good_python(size):
    return _again([rule.good for rule in file_rules("python")], max(1, size // 250))


def _again(examples, times):
    """Return examples again and again, each time with classes and functions of other names."""
    text = "\n".join(filter(None, examples))
    names = sorted(
        {*re.findall(r"\b(?:class|struct|def) (\w+)", text), *re.findall(r"\b(?:void|int|auto) (\w+)\(", text)}
    )
    kept = {"main", *(name for name in names if name.startswith("_"))}
    named = re.compile(r"\b(" + "|".join(name for name in names if name not in kept) + r")\b")
    return "\n".join(named.sub(rf"\1_{number}", text) for number in range(times))


def long_module(size):
    values = "".join(f"    'key_{n}': [{n}, 'a', f(x={n})],\n" for n in range(size))
    calls = "".join(
        f"    value_{n} = call(value, {n})\n    if value_{n} > 3:\n        log(value_{n})\n" for n in range(size)
    )
    return f"import rclpy\n\nTABLE = {{\n{values}}}\n\n\ndef run(value):\n{calls}    return value\n"


CPP = (tables, one_table, long_function, large_class, branches, good_cpp)
PYTHON = (long_module, good_python)
SIZE = 1000


@cache
def seen(make, size):
    language = Language.PYTHON if make in PYTHON else Language.CPP
    syntax = "python" if make in PYTHON else "cpp"
    parsed = parse_file(make(size).encode(), language, MacroSettings())
    parsed.facts(kinds_asked(syntax))
    view = parsed.view()
    match_file(view)
    return view


def seconds(make, size, rule):
    view = seen(make, size)
    begun = time.process_time()
    match_file(view, frozenset({rule}))
    return time.process_time() - begun


@pytest.mark.heavy
@pytest.mark.parametrize("make", [*CPP, *PYTHON], ids=lambda make: make.__name__)
def test_four_times_the_file_takes_about_four_times_as_long(make):
    syntax = "python" if make in PYTHON else "cpp"
    slow = {}
    for rule in file_rules(syntax):
        large = seconds(make, SIZE * GROWTH, rule.id)
        if large < LEAST_S:
            continue
        # The least of some turns is what it takes; what else the machine does only adds to it.
        large = min(large, *(seconds(make, SIZE * GROWTH, rule.id) for _ in range(2)))
        small = min(seconds(make, SIZE, rule.id) for _ in range(3))
        if large > GROWTH * SLACK * max(small, LEAST_S / GROWTH):
            slow[rule.id] = (round(small, 3), round(large, 3))
    assert not slow


def test_what_looks_through_the_file_for_each_node_is_told():
    def quadratic(size):
        content = b"x" * 200 * size
        return sum(b"y" in content for _ in range(size))

    def took(size):
        begun = time.process_time()
        quadratic(size)
        return time.process_time() - begun

    small, large = min(took(300) for _ in range(3)), min(took(300 * GROWTH) for _ in range(3))
    assert large > GROWTH * SLACK * small
