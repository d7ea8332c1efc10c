"""Changes of frame, scale and notation that change no answer [facts]."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from short_tables import arm, ask, degrees, numbers, shift

from cuspaudit.auditing.answer import Answer
from cuspaudit.auditing.deciders.certify import find_witness
from cuspaudit.certificate import verify
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import DegenerateMapError
from cuspaudit.robot.chain import (
    X_AXIS,
    Z_AXIS,
    Chain,
    Motion,
    Rotation,
    Translation,
)

Table = tuple[
    tuple[Fraction, ...], tuple[Fraction, ...], tuple[int, ...], tuple[int, ...], str
]

lengths = st.integers(1, 12).map(lambda k: Fraction(k, 4))
offsets = st.integers(-4, 4).map(lambda k: Fraction(k, 4))
twists = st.sampled_from((-90, 90))
kinds = st.sampled_from(("RRR", "RRR", "RRR", "RPR", "PRR", "RRP"))
tables = st.tuples(
    st.tuples(lengths, lengths, lengths),
    st.tuples(st.just(Fraction(0)), offsets, offsets),
    st.tuples(twists, st.sampled_from((-90, 90, 60)), st.just(0)),
    st.tuples(st.just(0), st.sampled_from((0, 90)), st.just(0)),
    kinds,
)
axes = st.sampled_from(
    [tuple(map(Fraction, v)) for v in ((1, 0, 0), (1, 2, 2), (2, -3, 6), (0, 3, 4))]
)
vectors = st.tuples(offsets, offsets, offsets).map(Translation)
turns = st.builds(
    lambda axis, angle: Rotation(axis, degrees(angle)),
    axes,
    st.sampled_from((90, -90, 180)),
)
motions = st.lists(vectors | turns, max_size=3).map(tuple)


#: one example costs two decisions and often two certificates
few = settings(max_examples=6)


def chain_of(table: Table) -> Chain:
    """The arm of a table."""
    a, d, alpha, theta, joints = table
    return arm(a, d, alpha, joints, theta)


def check_same(first: Chain, second: Chain) -> None:
    """Both have one answer, and a cuspidal one a certificate that verifies."""
    one, other = outcome(first), outcome(second)
    assert summary(one) == summary(other)
    for found, chain in ((one, first), (other, second)):
        if isinstance(found, Answer) and found.verdict is Verdict.CUSPIDAL:
            assert verify(find_witness(found, chain).certificate).accepted


def outcome(chain: Chain) -> Answer | str:
    """The answer, or the kind of error."""
    try:
        return ask(chain)
    except DegenerateMapError:
        return "degenerate"


def summary(found: Answer | str) -> tuple[object, ...]:
    """The numbers that must agree; counts that are not proved are left out."""
    return (found,) if isinstance(found, str) else numbers(found)


def mirrored(motion: Motion) -> Motion:
    """The motion seen in the mirror z = 0."""
    if isinstance(motion, Translation):
        x, y, z = motion.vector
        return Translation((x, y, -z))
    x, y, z = motion.axis
    return Rotation((-x, -y, z), motion.angle)


def mirror(chain: Chain) -> Chain:
    """The arm seen in the mirror z = 0; a sliding axis is a direction, not a turn."""
    joints = []
    for joint in chain.joints:
        x, y, z = joint.axis
        axis = (-x, -y, z) if joint.kind == "revolute" else (x, y, -z)
        before = tuple(map(mirrored, joint.before))
        joints.append(replace(joint, before=before, axis=axis))
    return replace(chain, joints=tuple(joints), tool=tuple(map(mirrored, chain.tool)))


def scaled(motion: Motion, factor: Fraction) -> Motion:
    """The motion with its lengths multiplied."""
    if isinstance(motion, Rotation):
        return motion
    x, y, z = motion.vector
    return Translation((factor * x, factor * y, factor * z))


@few
@given(tables)
def test_the_mirror_image(table: Table) -> None:
    """An arm and its mirror image have the same answer."""
    check_same(chain_of(table), mirror(chain_of(table)))


@few
@given(tables, st.sampled_from((Fraction(1, 1000), Fraction(3, 7), Fraction(40))))
def test_the_scale(table: Table, factor: Fraction) -> None:
    """Lengths in another unit change nothing."""
    chain = chain_of(table)
    joints = tuple(
        replace(joint, before=tuple(scaled(m, factor) for m in joint.before))
        for joint in chain.joints
    )
    tool = tuple(scaled(m, factor) for m in chain.tool)
    check_same(chain, replace(chain, joints=joints, tool=tool))


@few
@given(tables, motions)
def test_the_base(table: Table, base: tuple[Motion, ...]) -> None:
    """The arm may be mounted anywhere, turned any way."""
    chain = chain_of(table)
    first = chain.joints[0]
    moved = replace(first, before=base + first.before)
    check_same(chain, chain.with_joints((moved, *chain.joints[1:])))


@few
@given(tables, st.lists(turns, max_size=2).map(tuple))
def test_the_tool_s_orientation(table: Table, tool: tuple[Motion, ...]) -> None:
    """For a position task the tool may be turned about its point."""
    chain = chain_of(table)
    check_same(chain, replace(chain, tool=chain.tool + tool))


@few
@given(tables, offsets)
def test_d1(table: Table, d1: Fraction) -> None:
    """The height of the shoulder above the base changes nothing."""
    a, d, alpha, theta, joints = table
    check_same(chain_of(table), arm(a, (d1, *d[1:]), alpha, joints, theta))


@few
@given(tables, st.tuples(*[st.booleans()] * 3))
def test_the_sense_of_the_joints(table: Table, turned: tuple[bool, ...]) -> None:
    """A joint whose variable counts the other way changes nothing."""
    chain = chain_of(table)
    joints = tuple(
        replace(joint, axis=(Fraction(0), Fraction(0), Fraction(-1 if flip else 1)))
        for joint, flip in zip(chain.joints, turned, strict=True)
    )
    check_same(chain, chain.with_joints(joints))


@few
@given(tables, st.tuples(*[st.sampled_from((0, 30, 45, 90, -60))] * 3))
def test_the_zeros_of_the_joints(table: Table, zeros: tuple[int, ...]) -> None:
    """Where a turning joint counts from changes nothing, even by irrational cosines."""
    chain = chain_of(table)
    joints = tuple(
        replace(joint, before=(*joint.before, Rotation(Z_AXIS, degrees(zero))))
        if joint.kind == "revolute"
        else joint
        for joint, zero in zip(chain.joints, zeros, strict=True)
    )
    check_same(chain, chain.with_joints(joints))


@few
@given(tables)
def test_the_other_convention(table: Table) -> None:
    """The arm written in modified D-H, alpha and a one row later, is the same arm."""
    a, d, alpha, theta, joints = table
    tool = (shift(a[2], 0, 0), Rotation(X_AXIS, degrees(alpha[2])))
    other = arm((0, *a[:2]), d, (0, *alpha[:2]), joints, theta, modified=True)
    check_same(chain_of(table), replace(other, tool=other.tool + tool))


@few
@given(tables)
def test_the_joints_names(table: Table) -> None:
    """Names are labels."""
    chain = chain_of(table)
    joints = [replace(j, name=f"axis {3 - i}") for i, j in enumerate(chain.joints)]
    check_same(chain, chain.with_joints(joints))


@pytest.mark.slow
@given(tables, motions, motions)
@settings(max_examples=60)
def test_all_at_once(
    table: Table, base: tuple[Motion, ...], tool: tuple[Motion, ...]
) -> None:
    """Mirrored, mounted elsewhere, with a turned tool: the same answer."""
    chain = chain_of(table)
    first = chain.joints[0]
    joints = (replace(first, before=base + first.before), *chain.joints[1:])
    turned = tuple(m for m in tool if isinstance(m, Rotation))
    check_same(chain, mirror(replace(chain, joints=joints, tool=chain.tool + turned)))
