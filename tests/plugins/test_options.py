"""Options have the type that the plug-in declares, or the user learns which."""

import pytest

from roslens.model.errors import UsageError
from roslens.plugins.options import check_options, resolve_options
from roslens.plugins.points import Manifest, Option

MANIFEST = Manifest(
    "mine",
    "1.0",
    "1.0",
    options=(
        Option("depth", "int", "how deep", default=3),
        Option("share", "float", "what share", default=1),
        Option("name", "str", "which name"),
        Option("strict", "bool", "whether", default=False),
        Option("words", "list", "which words", default=["a"]),
    ),
)


def test_defaults_and_given_values():
    assert resolve_options(MANIFEST, {"depth": 5, "words": ["b", "c"]}) == {
        "depth": 5,
        "share": 1.0,
        "name": None,
        "strict": False,
        "words": ["b", "c"],
    }


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"dept": 1}, "[options.mine] dept: unknown option 'dept'; expected one of depth, name, share, strict, words"),
        ({"depth": "5"}, "[options.mine] depth: found '5' (str); expected int. how deep"),
        ({"depth": True}, "[options.mine] depth: found True (bool); expected int"),
        ({"depth": 1.5}, "[options.mine] depth: found 1.5 (float); expected int"),
        ({"strict": 1}, "[options.mine] strict: found 1 (int); expected bool"),
        ({"words": "a"}, "[options.mine] words: found 'a' (str); expected list"),
        ({"words": ["a", 1]}, "[options.mine] words: found a list with 1 (int); expected list"),
    ],
)
def test_wrong_options_are_told(given, message):
    with pytest.raises(UsageError) as error:
        resolve_options(MANIFEST, given)
    assert str(error.value).startswith(message)


def test_options_of_an_unknown_plugin_name_the_nearest():
    check_options({"mine": MANIFEST}, {"mine": {"depth": 1}})
    with pytest.raises(
        UsageError, match=r"options for unknown plug-in 'mime'; expected one of mine\. Did you mean 'mine'"
    ):
        check_options({"mine": MANIFEST}, {"mime": {}})
    with pytest.raises(UsageError, match="expected no option: the plug-in has none"):
        resolve_options(Manifest("bare", "1.0", "1.0"), {"depth": 1})
