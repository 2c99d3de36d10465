"""Quaternions as tf2 computes with them: product, rotated vector, spherical interpolation."""

from __future__ import annotations

from math import acos, sin, sqrt

from roslens.model.transforms.transform import Quaternion, Vector


def product(one: Quaternion, other: Quaternion) -> Quaternion:
    """Return the rotation that is ``other`` followed by ``one``."""
    x, y, z, w = one
    a, b, c, d = other
    return (
        w * a + x * d + y * c - z * b,
        w * b + y * d + z * a - x * c,
        w * c + z * d + x * b - y * a,
        w * d - x * a - y * b - z * c,
    )


def inverse(one: Quaternion) -> Quaternion:
    """Return the rotation back."""
    return (-one[0], -one[1], -one[2], one[3])


def rotated(one: Quaternion, vector: Vector) -> Vector:
    """Return a rotated vector."""
    x, y, z, _ = product(product(one, (*vector, 0.0)), inverse(one))
    return (x, y, z)


def added(one: Vector, other: Vector) -> Vector:
    """Return the sum of two vectors."""
    return (one[0] + other[0], one[1] + other[1], one[2] + other[2])


def between(one: Quaternion, other: Quaternion, ratio: float) -> Quaternion:
    """Return the spherical interpolation between two rotations, the shorter way (`tf2::Quaternion::slerp`)."""
    dot = sum(a * b for a, b in zip(one, other, strict=True))
    length = sqrt(sum(a * a for a in one) * sum(b * b for b in other))
    if not length:
        return one
    sign = -1.0 if dot < 0 else 1.0
    theta = acos(min(1.0, sign * dot / length))
    if theta == 0.0:
        return one
    first, second = sin((1 - ratio) * theta) / sin(theta), sign * sin(ratio * theta) / sin(theta)
    x, y, z, w = (first * a + second * b for a, b in zip(one, other, strict=True))
    return (x, y, z, w)
