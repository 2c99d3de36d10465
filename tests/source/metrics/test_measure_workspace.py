from __future__ import annotations

from roslens.source.metrics.measure_workspace import measure_workspace


def test_every_package_has_all_four_values(package_of):
    assert measure_workspace([package_of("b: a x"), package_of("a:")]) == {
        "a": {"dependencies": 0.0, "dependents": 1.0, "tier": 0.0, "cycle": 0.0},
        "b": {"dependencies": 2.0, "dependents": 0.0, "tier": 1.0, "cycle": 0.0},
    }


def test_the_order_of_packages_does_not_matter(package_of):
    packages = [package_of(line) for line in ("a: b", "b: c", "c: a", "d: a")]
    straight = measure_workspace(packages)
    turned = measure_workspace(packages[::-1])
    assert list(straight.items()) == list(turned.items())


def test_values_are_floats_as_after_reading_them_back(package_of):
    values = measure_workspace([package_of("a:")])["a"].values()
    assert all(type(value) is float for value in values)


def test_an_empty_workspace_has_none():
    assert measure_workspace([]) == {}
