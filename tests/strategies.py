"""Hypothesis strategies for chains, tables and URDF texts, whole and damaged."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import strategies as st

from cuspaudit.robot.chain import (
    Angle,
    Chain,
    Joint,
    Motion,
    Rotation,
    Translation,
    Vector,
)

_SMALL = st.integers(-4, 4).map(lambda n: Fraction(n, 2))
_DECIMAL = st.integers(-(10**7), 10**7).map(lambda n: Fraction(n, 10**6))
LENGTHS = st.one_of(_SMALL, _DECIMAL, st.fractions(-9, 9, max_denominator=99))
HALF_TURNS = st.sampled_from([Fraction(n, 12) for n in range(-24, 25)])
ANGLES = st.one_of(
    st.sampled_from([Angle(Fraction(n, 2)) for n in range(-3, 4)]),
    st.builds(Angle, HALF_TURNS),
    _DECIMAL.map(lambda x: Angle(radians=x)),
    st.builds(Angle, HALF_TURNS, _DECIMAL),
)
_ALONG: list[Vector] = [
    (Fraction(x), Fraction(y), Fraction(z))
    for x, y, z in [(1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 0, -1), (-1, 0, 0), (0, -2, 0)]
]
VECTORS = st.tuples(LENGTHS, LENGTHS, LENGTHS)
AXES = st.one_of(st.sampled_from(_ALONG), VECTORS.filter(any))
MOTIONS: st.SearchStrategy[Motion] = st.one_of(
    VECTORS.map(Translation), st.builds(Rotation, AXES, ANGLES)
)
NAMES = st.text(
    st.characters(exclude_categories=("Cs", "Cc", "Cn", "Co", "Zl", "Zp", "Cf", "Zs")),
    min_size=1,
    max_size=8,
).filter(lambda name: name not in ("null", "~") and not name.isdigit())


@st.composite
def chains(draw: st.DrawFn, most: int = 4) -> Chain:
    """A chain of up to ``most`` joints, its frames and axes often square."""
    names = draw(st.lists(NAMES, min_size=1, max_size=most, unique=True))
    joints = []
    for name in names:
        kind = draw(st.sampled_from(["revolute", "revolute", "prismatic"]))
        before = draw(st.lists(MOTIONS, max_size=4))
        joints.append(Joint(name, kind, tuple(before), draw(AXES)))
    return Chain(
        name=draw(NAMES),
        joints=tuple(joints),
        tool=tuple(draw(st.lists(MOTIONS, max_size=3))),
        task=draw(st.sampled_from(["position", "pose"])),
        unit=draw(st.sampled_from(["m", "mm"])),
    )


_NUMBER = st.one_of(
    st.sampled_from(["0", "1", "-2", "0.5", "1.5708", "1e-3", "-1e-300", ".5", "5."]),
    st.sampled_from(
        [
            "nan",
            "inf",
            "1_0",
            "1e999999999",
            "pi/2",
            "${x}",
            "0x10",
            "１",
            "-",
            "1e400",
            "1e",
        ]
    ),
    st.text(max_size=4),
)
_CELL = st.one_of(
    st.sampled_from(
        [
            "0",
            "1",
            "3/2",
            "pi/2",
            "-pi",
            "90deg",
            "pi/0",
            "1/0",
            "q1",
            "a*2",
            "standard",
            "mm",
        ]
    ),
    _NUMBER,
)


@st.composite
def urdf_texts(draw: st.DrawFn) -> str:
    """A URDF of a few joints whose numbers may be anything, tags whole."""
    links = draw(st.integers(1, 5))
    triple = st.lists(_NUMBER, min_size=3, max_size=3).map(" ".join)
    kinds = ["revolute", "continuous", "prismatic", "fixed", "floating", ""]
    parts = [f'<link name="l{k}"/>' for k in range(links)]
    for k in range(draw(st.integers(0, 5))):
        parent, child = draw(st.integers(0, links)), draw(st.integers(0, links))
        attributes = {
            key: _escaped(draw(triple)) for key in ("xyz", "rpy", "axis", "limit")
        }
        parts.append(
            f'<joint name="j{k}" type="{draw(st.sampled_from(kinds))}">'
            f'<parent link="l{parent}"/><child link="l{child}"/>'
            f'<origin xyz="{attributes["xyz"]}" rpy="{attributes["rpy"]}"/>'
            f'<axis xyz="{attributes["axis"]}"/>'
            f'<limit lower="{attributes["limit"]}" upper="1"/></joint>'
        )
    return f'<robot name="arm">{"".join(parts)}</robot>'


def _escaped(text: str) -> str:
    for character, entity in (("&", "&amp;"), ("<", "&lt;"), ('"', "&quot;")):
        text = text.replace(character, entity)
    return text


@st.composite
def table_texts(draw: st.DrawFn) -> str:
    """A robot file in YAML whose cells may be anything."""
    keys = [
        "type",
        "a",
        "alpha",
        "d",
        "theta",
        "sign",
        "limits",
        "before",
        "axis",
        "name",
        "joint",
        "beta",
    ]
    rows = []
    for _ in range(draw(st.integers(0, 3))):
        cells = draw(st.dictionaries(st.sampled_from(keys), _CELL, max_size=7))
        whole = {"type": "R", "a": "1", "alpha": "0", "d": "0", **cells}
        rows.append(", ".join(f"{key}: {value}" for key, value in whole.items()))
    head = draw(
        st.dictionaries(
            st.sampled_from(["units", "task", "name", "tool", "expect", "base"]), _CELL
        )
    )
    lines = ["convention: standard", *(f"{k}: {v}" for k, v in head.items())]
    return "\n".join([*lines, "joints:", *(f"  - {{{row}}}" for row in rows), ""])


@st.composite
def damaged(draw: st.DrawFn, text: str) -> bytes:
    """``text`` with a few bytes changed, cut out, or doubled."""
    content = bytearray(text.encode())
    for _ in range(draw(st.integers(1, 4))):
        at = draw(st.integers(0, max(len(content) - 1, 0)))
        until = at + draw(st.integers(0, 12))
        piece = draw(st.one_of(st.binary(max_size=6), st.just(content[at:until] * 2)))
        content[at:until] = piece
    return bytes(content)
