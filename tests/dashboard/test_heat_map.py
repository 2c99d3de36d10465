"""The heat map of a study: a sign for a direction, none where the value rounds to nothing."""

from types import SimpleNamespace

import pytest

from roslens.dashboard.study.heat_map import heat_map


def study(value, adjusted=0.0):
    columns = [SimpleNamespace(key=key, title=key.upper()) for key in ("a", "b")]
    spearman = SimpleNamespace(value=value, low=value - 0.1, high=value + 0.1, adjusted=adjusted)
    pair = SimpleNamespace(one="a", other="b", spearman=spearman)
    return SimpleNamespace(
        correlations=[pair],
        corpus=SimpleNamespace(columns=columns),
        column=lambda key: next(one for one in columns if one.key == key),
    )


@pytest.mark.parametrize(
    ("value", "text", "strength", "positive"),
    [(0.96, "+1.0", 4, True), (-0.52, "-.5", 2, False), (0.04, "0", 0, True), (-0.04, "0", 0, False)],
)
def test_what_a_tile_says(value, text, strength, positive):
    (tile,) = heat_map(study(value)).tiles
    assert (tile.text, tile.strength, tile.positive, tile.doubtful) == (text, strength, positive, False)


def test_what_may_be_chance_is_said():
    (tile,) = heat_map(study(0.3, adjusted=0.2)).tiles
    assert tile.doubtful
    assert tile.label.endswith(", may be chance")
