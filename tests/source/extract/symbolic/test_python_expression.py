import contextlib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.extract.symbolic.python_expression import UnknownError, evaluate


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("1 + 2 * 3", 7),
        ("'a' + \"b\"", "ab"),
        ("not use_sim and mode == 'fast'", True),
        ("'sim' if use_sim else 'real'", "real"),
        ("mode in ['fast', 'slow']", True),
        ("1 < count <= 3", True),
        ("-count // 2", -2),
        ("f'/{mode}/{count}'", "/fast/3"),
        ("mode.upper()[0]", "F"),
        ("mode[1:]", "ast"),
        ("'%s_%d' % (mode, count)", "fast_3"),
        ("int('4') + float('0.5')", 4.5),
        ("arg('robot')", "r2"),
        ("{'a': 1}.get('b', 2)", 2),
        ("'a,b'.split(',')", ("a", "b")),
        ("math.pi > 3 and round(sqrt(16)) == 4", True),
        ("true or missing", True),
        ("None is None", True),
    ],
)
def test_values(expression, value):
    names = {"use_sim": False, "mode": "fast", "count": 3}
    functions = {"arg": {"robot": "r2"}.__getitem__}
    assert evaluate(expression, names, functions) == value


@pytest.mark.parametrize(
    ("expression", "reason"),
    [
        ("missing", "'missing' is not defined"),
        ("__import__('os').system('true')", "not evaluated"),
        ("(1).__class__", "not evaluated"),
        ("'{0.__class__}'.format(1)", "not evaluated"),
        ("open('/etc/passwd')", "not evaluated"),
        ("[x for x in (1, 2)]", "not evaluated"),
        ("lambda: 1", "not evaluated"),
        ("'a' * 100000", "too long"),
        ("99999999999999999999 * 99999999999999999999", "too large"),
        ("9 ** 9 ** 9", "not evaluated"),
        ("'%*d' % (1000000000, 1)", "format"),
        ("'%1000000000d' % 1", "format"),
        ("'aaaa'.replace('', 'b' * 9000)", "too long"),
        ("1 / 0", "fails"),
        ("'a' + 1", "fails"),
        ("1 +", "not a Python expression"),
        ("(" * 500 + ")" * 500, "not a Python expression"),
        ("-" * 200 + "1", "too many steps"),
        ("a" * 20_000, "characters"),
    ],
)
def test_what_is_unknown_says_why(expression, reason):
    with pytest.raises(UnknownError, match=reason):
        evaluate(expression)


@given(st.text(st.sampled_from("abs()[]{}'\"+-*/%<>=!,.:0123456789 notinor"), max_size=40))
def test_never_fails_otherwise(expression):
    with contextlib.suppress(UnknownError):
        evaluate(expression, {"a": "b"}, {})
