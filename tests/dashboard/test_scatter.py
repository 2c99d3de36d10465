"""Where dots stand, and which of them are named."""

from roslens.dashboard.charts.scatter import HEIGHT, LABELLED, WIDTH, scatter_of


def test_axes_are_decades():
    found = scatter_of([("a/x.cpp", "x", 1000, 10, 4), ("y.cpp", "y", 1, 1, 1)])
    assert found is not None
    assert [text for _, text in found.across] == ["1", "10", "100", "1,000"]
    assert [text for _, text in found.up] == ["1", "10"]
    assert [(dot.x, dot.y) for dot in found.dots] == [(WIDTH, 0.0), (0.0, HEIGHT)]
    assert found.dots[0].radius > found.dots[1].radius
    assert (found.dots[0].label, found.dots[0].left) == ("x.cpp", True)


def test_names_keep_clear_of_each_other():
    found = scatter_of([(f"{place}.cpp", "", 100, 100, 1) for place in range(20)])
    assert found is not None
    assert 1 <= len([dot for dot in found.dots if dot.label]) <= 2
    apart = scatter_of([(f"{place}.cpp", "", 10, 10.0**place, 1) for place in range(9)])
    assert apart is not None
    assert len([dot for dot in apart.dots if dot.label]) == LABELLED


def test_nothing_and_nought():
    assert scatter_of([]) is None
    found = scatter_of([("a", "", 0, 0, 0)])
    assert found is not None
    assert (found.dots[0].x, found.dots[0].y) == (0.0, HEIGHT)
