from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from flint import arb
from short_tables import Number, arm, with_wrist

from cuspaudit.algebra.ring import Polynomial
from cuspaudit.errors import UnableError
from cuspaudit.geometry.crit import crit
from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.exact_model import ExactModel, exact_model
from cuspaudit.kinematics.polynomial_map import (
    polynomial_map,
    reduce_circles,
    reduced_map,
)
from cuspaudit.robot.frames import angle_value, frames, jacobian
from cuspaudit.surface.surface import Surface, product_factors

Row = tuple[Number, ...]
ARMS: dict[str, tuple[Row, Row, Row, str, Row]] = {
    "ISSAC": ((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0), "RRR", ()),
    "offsets": ((1, 2, "3/2"), ("1/3", 1, "-1/2"), (-30, 60, 45), "RRR", (10, 90, 37)),
    "general": ((1, "1.3", ".9"), (0, ".4", "-.7"), (70, 110, 0), "RRR", ()),
    "RPR": ((1, 2, "3/2"), (0, 1, "1/4"), (-90, 60, 0), "RPR", (0, 30, 0)),
    "PRR": ((1, 2, "3/2"), (0, 1, "1/4"), (-60, 90, 0), "PRR", ()),
    "RRP": ((1, 2, "3/2"), (0, 1, "1/4"), (-90, 45, 0), "RRP", ()),
    "PPR": ((1, 2, "3/2"), (0, 1, "1/4"), (-90, 45, 0), "PPR", ()),
    "PRP": ((1, 2, "3/2"), (0, 1, "1/4"), (-90, 45, 0), "PRP", ()),
    "RPP": ((1, 2, "3/2"), (0, 1, "1/4"), (-90, 45, 0), "RPP", ()),
    "PPP": ((1, 2, "3/2"), (0, 1, "1/4"), (-60, 45, 0), "PPP", ()),
}
SIX: dict[str, tuple[Row, Row, Row]] = {
    "CRX-10iA/L": (
        (0, ".71", 0, 0, 0, 0),
        (".245", 0, 0, ".54", ".15", ".16"),
        (-90, 0, -90, 90, -90, 0),
    ),
    "JACO": (
        (0, ".41", 0, 0, 0, 0),
        (".212", 0, "-.012", "-.2493", "-.0846", "-.22273"),
        (90, 180, 90, 55, 55, 180),
    ),
    "hyperplane": (
        (10, 100, 150, 20, 5, 20),
        (100, 50, 50, -50, -20, 10),
        (-30, 30, 60, -30, -30, 45),
    ),
}


def model_of(name: str) -> ExactModel:
    """The model of an arm."""
    a, d, alpha, kinds, theta = ARMS[name]
    return exact_model(arm(a, d, alpha, kinds, theta))


def assign(model: ExactModel, values: np.ndarray) -> dict[str, arb]:
    """The variables of the ring at joint values."""
    at: dict[str, arb] = {}
    for joint, value in zip(model.joints, values, strict=True):
        if joint.kind == "prismatic":
            at[joint.variables[0]] = arb(float(value))
            continue
        turned = float(value) + angle_value(joint.zero)
        c, s = joint.variables
        at |= {c: arb(math.cos(turned)), s: arb(math.sin(turned))}
    return at


def number(model: ExactModel, polynomial: Polynomial, values: np.ndarray) -> float:
    """A polynomial of the model's ring at joint values."""
    return float(model.ring.evaluate(polynomial, assign(model, values)).mid())


def postures(count: int, joints: int) -> np.ndarray:
    """Seeded random joint values."""
    return np.random.default_rng(7).uniform(-3, 3, (count, joints))


@pytest.mark.parametrize("name", ARMS)
def test_the_map_is_the_forward_kinematics(name: str) -> None:
    """Position and rotation of the tip at random postures, by two routes."""
    model = model_of(name)
    kinematic = polynomial_map(model)
    for q in postures(4, 3):
        tip = frames(model.chain, q)[-1]
        position = [number(model, p, q) for p in kinematic.position.components]
        rotation = [number(model, p, q) for p in kinematic.rotation.components]
        assert np.allclose(position, tip[:3, 3], atol=1e-9)
        assert np.allclose(rotation, tip[:3, :3].ravel(), atol=1e-9)


@pytest.mark.parametrize("name", ARMS)
def test_det_j_is_that_of_the_geometric_jacobian(name: str) -> None:
    """The determinant at random postures, and its differences along joint 1: none."""
    model = model_of(name)
    determinant = jacobian_determinant(model)
    for q in postures(4, 3):
        wanted = np.linalg.det(jacobian(model.chain, q))
        assert math.isclose(number(model, determinant, q), wanted, abs_tol=1e-9)
    first = model.joints[0].variables
    assert all(determinant.derivative(name) == 0 for name in first)


@pytest.mark.parametrize("name", SIX)
def test_det_j_of_six_joints(name: str) -> None:
    """The same for a pose task; joints 1 and 6 do not matter."""
    model = exact_model(arm(*SIX[name]))
    determinant = jacobian_determinant(model)
    for q in postures(3, 6):
        wanted = np.linalg.det(jacobian(model.chain, q))
        found = number(model, determinant, q)
        assert math.isclose(found, wanted, rel_tol=1e-7, abs_tol=1e-9)
    for joint in (model.joints[0], model.joints[5]):
        assert all(determinant.derivative(name) == 0 for name in joint.variables)


def test_det_j_of_the_crx_is_small() -> None:
    """Eight terms for a FANUC CRX-10iA/L [mathematics 6]."""
    assert len(jacobian_determinant(exact_model(arm(*SIX["CRX-10iA/L"])))) == 8


def test_det_j_of_a_wrist_is_a_product() -> None:
    """The determinant of an arm with a wrist is that of its 3R arm times sin theta5."""
    chain = arm((1, 2, "3/2"), (0, 1, 0), (-90, 90, 0))
    model = exact_model(with_wrist(chain))
    whole = jacobian_determinant(model)
    regional = jacobian_determinant(exact_model(chain))
    s5 = model.ring.gen("s5")
    product = model.ring.from_other(regional, exact_model(chain).ring) * s5
    product = reduce_circles(model.ring, model.joints, product)
    assert whole in (product, -product)


@pytest.mark.parametrize("name", [n for n in ARMS if n != "PPP"])
def test_the_reduced_map_has_the_same_singularities(name: str) -> None:
    """Its Jacobian determinant is det J times a constant [mathematics 5]."""
    model = model_of(name)
    variety, mapping = reduced_map(model)
    surface = Surface(variety.ring, *product_factors(variety))
    (delta,) = crit(variety, mapping)
    reduced = surface.reduce(delta)
    own = surface.reduce(
        variety.ring.from_other(jacobian_determinant(model), model.ring)
    )
    exponents = next(iter(own.to_dict()))
    cross = reduced * own.to_dict()[exponents] - own * reduced.to_dict().get(
        exponents, 0
    )
    if variety.ring.radicand is None:
        assert cross == 0
    ratios = []
    for q in postures(5, 3):
        inner = {
            k: v for k, v in assign(model, q).items() if k in variety.ring.variables
        }
        above = float(variety.ring.evaluate(reduced, inner).mid())
        below = float(variety.ring.evaluate(own, inner).mid())
        ratios.append(above / below)
    assert np.allclose(ratios, ratios[0], rtol=1e-6)


@pytest.mark.parametrize("name", ARMS)
def test_the_reduced_map_is_what_joint_1_cannot_change(name: str) -> None:
    """Its values do not move with joint 1, and tell positions apart up to joint 1."""
    model = model_of(name)
    variety, mapping = reduced_map(model)
    q = postures(1, 3)[0]
    inner = {k: v for k, v in assign(model, q).items() if k in variety.ring.variables}
    u, v = (float(variety.ring.evaluate(r, inner).mid()) for r in mapping.components)
    frame = frames(model.chain, (0.0, *q[1:]))
    axis = frame[0, :3, :3] @ [float(x) for x in model.chain.joints[0].axis]
    arrow = frame[-1, :3, 3] - frame[0, :3, 3]
    if model.chain.joints[0].kind == "revolute":
        # |p|^2 and z1 . p from the foot of joint 2's origin on axis 1
        across = arrow @ arrow - (axis @ arrow) ** 2
        assert math.isclose(u - v * v, across, abs_tol=1e-8)
    moved = [frames(model.chain, (t, *q[1:]))[-1, :3, 3] for t in (0.3, -1.1)]
    if model.chain.joints[0].kind == "prismatic":
        step = (moved[1] - moved[0]) / -1.4
        assert np.allclose(step, axis, atol=1e-9)


def test_tasks_must_fit() -> None:
    """Six joints for a position task have no determinant."""
    six = arm((1,) * 6, (0,) * 6, (90,) * 6)
    three = arm((1,) * 3, (0,) * 3, (90,) * 3)
    for chain in (replace(six, task="position"), replace(three, task="pose")):
        with pytest.raises(UnableError, match="joints for a"):
            jacobian_determinant(exact_model(chain))


def test_reduction_modulo_the_circles() -> None:
    """c^2 becomes 1 - s^2 and the function stays."""
    model = model_of("ISSAC")
    c1, s1 = model.ring.gen("c1"), model.ring.gen("s1")
    reduced = reduce_circles(model.ring, model.joints, c1**3 + s1)
    assert reduced == c1 * (1 - s1**2) + s1
