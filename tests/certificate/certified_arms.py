"""Certificates of known cuspidal arms, made with nothing but floats and Newton.

The numbers are published [facts], and each couple's straight segment is said to be
nonsingular. `kinematics` below is a second, independent
description of the arm (matrices of floats), to compare the ball arithmetic with.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cache
from typing import Any

import numpy as np

from cuspaudit.certificate import (
    CertifiedJoint,
    Loose,
    Motion,
    PathCertificate,
    Rotate,
    Translate,
)

X = (Fraction(1), Fraction(0), Fraction(0))
Z = (Fraction(0), Fraction(0), Fraction(1))


def exact(row: Sequence[Any]) -> tuple[Fraction, ...]:
    """The shortest decimals that print as these floats, exactly."""
    return tuple(Fraction(str(x)) for x in row)


def translate(*row: Any) -> Translate:
    """A translation by these decimals."""
    x, y, z = exact(row)
    return Translate((x, y, z))


def from_dh(
    a: Sequence[float],
    d: Sequence[float],
    alpha_deg: Sequence[float],
    kinds: str = "",
    theta_deg: Sequence[float] = (),
) -> tuple[tuple[CertifiedJoint, ...], tuple[Motion, ...]]:
    """Joints and tool of a standard D-H table: Rz(theta) Tz(d) Tx(a) Rx(alpha)."""
    joints: list[CertifiedJoint] = []
    pending: tuple[Motion, ...] = ()
    for i, (length, offset, twist) in enumerate(zip(a, d, alpha_deg, strict=True)):
        kind = "prismatic" if kinds[i : i + 1] == "P" else "revolute"
        if theta_deg:
            pending += (Rotate(Z, Fraction(str(theta_deg[i])) / 180),)
        joints.append(CertifiedJoint(f"joint_{i + 1}", kind, Z, pending))
        turn = Rotate(X, Fraction(str(twist)) / 180)
        pending = (translate(0, 0, offset), translate(length, 0, 0), turn)
    return tuple(joints), pending


def from_poe(
    H: Sequence[Sequence[float]], P: Sequence[float]
) -> tuple[tuple[CertifiedJoint, ...], tuple[Motion, ...]]:
    """Joints and tool of a product of exponentials with axes H and offsets P."""
    joints = []
    for i, h in enumerate(H):
        x, y, z = exact(h)
        before = (translate(*P[3 * i : 3 * i + 3]),)
        joints.append(CertifiedJoint(f"joint_{i + 1}", "revolute", (x, y, z), before))
    return tuple(joints), (translate(*P[-3:]),)


def _matrix(axis: Sequence[Any], angle: float) -> np.ndarray:
    n = np.array([float(x) for x in axis])
    n /= np.linalg.norm(n)
    K = np.array([[0, -n[2], n[1]], [n[2], 0, -n[0]], [-n[1], n[0], 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


def _motion(motion: Motion) -> np.ndarray:
    T = np.eye(4)
    if isinstance(motion, Loose):
        return T  # as drawn
    if isinstance(motion, Translate):
        T[:3, 3] = [float(x) for x in motion.vector]
    else:
        angle = float(motion.half_turns) * np.pi + float(motion.radians)
        T[:3, :3] = _matrix(motion.axis, angle)
    return T


def kinematics(arm: PathCertificate, q: Sequence[Any]) -> tuple[np.ndarray, np.ndarray]:
    """The tip's frame, and the 6xn geometric Jacobian, linear rows first, in floats."""
    T, screws = np.eye(4), []
    for joint, value in zip(arm.joints, q, strict=True):
        for motion in joint.before:
            T = T @ _motion(motion)
        n = np.array([float(x) for x in joint.axis])
        n /= np.linalg.norm(n)
        turns = joint.kind == "revolute"
        screws.append((turns, T[:3, :3] @ n, T[:3, 3].copy()))
        M = np.eye(4)
        if turns:
            M[:3, :3] = _matrix(joint.axis, float(value))
        else:
            M[:3, 3] = n * float(value)
        T = T @ M
    for motion in arm.tool:
        T = T @ _motion(motion)
    columns = [
        np.r_[np.cross(w, T[:3, 3] - o), w] if turns else np.r_[w, 0, 0, 0]
        for turns, w, o in screws
    ]
    return T, np.array(columns).T


def det(arm: PathCertificate, q: Sequence[Any]) -> float:
    """Det J of the task in floats."""
    J = kinematics(arm, q)[1]
    return float(np.linalg.det(J[: len(arm.joints)]))


def refined(arm: PathCertificate, first: Sequence[Any], second: Sequence[Any]) -> Any:
    """The posture of the pose of ``first`` next to ``second``, by Newton in floats."""
    target, n = kinematics(arm, first)[0], len(arm.joints)
    q = np.array([float(x) for x in second])
    for _ in range(10):
        T, J = kinematics(arm, q)
        E = target[:3, :3] @ T[:3, :3].T
        skew = [E[2, 1] - E[1, 2], E[0, 2] - E[2, 0], E[1, 0] - E[0, 1]]
        error = np.r_[target[:3, 3] - T[:3, 3], np.array(skew) / 2]
        q = q + np.linalg.solve(J[:n], error[:n])
    return exact([float(x) for x in q])


def certify(
    name: str,
    robot: tuple[tuple[CertifiedJoint, ...], tuple[Motion, ...]],
    first: Sequence[float],
    second: Sequence[float],
) -> PathCertificate:
    """The straight path between two postures, the second one refined."""
    joints, tool = robot
    task = "position" if len(joints) == 3 else "pose"
    a = exact(first)
    arm = PathCertificate(
        robot_name=name,
        task=task,
        unit="m",
        joints=joints,
        tool=tool,
        sign=1,
        postures=(a, a),
        path=(a, a),
        made_by="the tests",
    )
    return with_second(arm, refined(arm, a, second))


def with_second(arm: PathCertificate, second: tuple[Fraction, ...]) -> PathCertificate:
    """The certificate with another second posture, a straight path and det J's sign."""
    first = arm.postures[0]
    sign = 1 if det(arm, first) > 0 else -1
    return replace(arm, sign=sign, postures=(first, second), path=(first, second))


def divided(arm: PathCertificate, pieces: int) -> PathCertificate:
    """The same path, each segment divided into pieces, exactly."""
    path = [arm.path[0]]
    for a, b in zip(arm.path, arm.path[1:], strict=False):
        path += [
            tuple(x + (y - x) * Fraction(k, pieces) for x, y in zip(a, b, strict=True))
            for k in range(1, pieces + 1)
        ]
    return replace(arm, path=tuple(path))


@cache
def issac() -> PathCertificate:
    """The ISSAC 2022 example with its published path in (theta2, theta3)."""
    robot = from_dh([1, 2, 1.5], [0, 1, 0], [-90, 90, 0])
    first, end = (0.0, -0.742, 2.628), np.array([-3, -0.5])
    arm = certify("issac", robot, first, first)

    def plane(angles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        T, J = kinematics(arm, (0, *angles))
        x, y, z = T[:3, 3]
        rows = np.array([2 * x * J[0] + 2 * y * J[1], J[2]])
        return np.array([x * x + y * y, z]), rows[:, 1:]

    for _ in range(10):
        value, J = plane(end)
        end = end + np.linalg.solve(J, plane(np.array(first[1:]))[0] - value)
    x, y = kinematics(arm, first)[0][:2, 3]
    u, v = kinematics(arm, (0, *end))[0][:2, 3]
    turn = np.arctan2(y, x) - np.arctan2(v, u)
    return with_second(arm, refined(arm, arm.postures[0], (turn, *end)))


@cache
def sliding() -> PathCertificate:
    """A cuspidal arm whose second joint slides."""
    robot = from_dh([1.5, 0.5, 2], [0, 0, 1], [60, -60, 0], "RPR", [0, 30, 0])
    first = [-1.4892296592379715, 0.8032106201907725, -1.6524598544521825]
    second = [-3.091351087133919, -0.31123489472750016, 0.6771990126888703]
    return certify("sliding", robot, first, second)


@cache
def jaco_gen2() -> PathCertificate:
    """Kinova JACO Gen2 [facts, erratum 2], couple 6, 7."""
    robot = from_dh(
        [0, 0.41, 0, 0, 0, 0],
        [0.212, 0, -0.012, -0.2493, -0.0846, -0.22273],
        [90, 180, 90, 55, 55, 180],
    )
    a = -3.120092470828, 0.708443663229, 1.490229800567
    b = 2.61999307176, -1.963267524543, -1.881961383418
    c = 2.472352422606, 0.093721874112, 2.028182382333
    d = -1.491333538969, -2.42332307626, 2.434887957753
    return certify("jaco_gen2", robot, (*a, *b), (*c, *d))


@cache
def crx() -> PathCertificate:
    """FANUC CRX-10iA/L."""
    H = [[0, 0, 1], [0, 1, 0], [0, -1, 0], [-1, 0, 0], [0, -1, 0], [-1, 0, 0]]
    P = [0, 0, 0.245, 0, 0, 0, 0, 0, 0.71, 0, 0, 0, 0.54, -0.15, 0, 0.16, *[0] * 5]
    a = -3.10159265359, -1.98, -1.36159265359, 0.47159265359, 0.32, -1.94
    b = -2.351541039862, -2.089140450037, -0.943744242273
    c = 4.202133156789, 0.36555118529, -5.061892439164
    return certify("crx", from_poe(H, P), a, (*b, *c))


@cache
def gofa() -> PathCertificate:
    """ABB GoFa 5."""
    H = [[0, 0, 1], [0, 1, 0], [0, 1, 0], [1, 0, 0], [0, 1, 0], [1, 0, 0]]
    P = [0, 0, 0, 0, 0, 0.265, 0, 0, 0.444, 0, 0, 0.11, 0.47]
    P += [0, 0, 0, 0, 0.08, 0.101, 0, 0]
    a = -0.8, 0.59, 2.34, 2.72, 1.06, -1.84
    b = 2.259908262326, 2.19985826615, 2.667688761117
    c = 2.529777454606, -2.528612242718, 0.48314656653
    return certify("gofa", from_poe(H, P), a, (*b, *c))


@cache
def jaco2() -> PathCertificate:
    """Kinova JACO 2, snapped; its fifth axis is a unit vector in 15 digits only."""
    H = [[0, 0, -1], [0, -1, 0], [0, 1, 0], [0, 0, -1]]
    H += [[0, -0.866025403784439, -0.5], [0, 0, -1]]
    P = [0, 0, 0.15675, 0, 0.0016, 0.11875, 0, 0, -0.41, 0, -0.0114, 0.2073]
    P += [0, 0.03703, 0.06414, 0, 0.03703, 0.06414, 0, 0, 0.16]
    a = -1.648410281258, 2.283285436426, 0.492104361132
    b = 0.020057768214, -1.878516820424, 1.110688778004
    c = 0.990639546092, 2.605670258822, 0.303040618222
    d = 2.060658963384, -2.908297691948, -0.296983527512
    return certify("jaco2", from_poe(H, P), (*a, *b), (*c, *d))


@cache
def xarm6() -> PathCertificate:
    """UFACTORY xArm6, snapped."""
    H = [[0, 0, 1], [0, 1, 0], [0, 1, 0], [0, 0, -1], [0, 1, 0], [0, 0, -1]]
    P = [0, 0, 0.267, 0, 0, 0, 0.0535, 0, 0.2845, 0.0775, 0, -0.3425]
    P += [0, 0, 0, 0.076, 0, -0.097, 0, 0, 0]
    a = -0.496835034695, -1.779707150236, -0.029628901299
    b = -0.428190437316, 0.84766969277, -1.051444278015
    c = 2.41913727588, -1.84254702967, -0.487893816283
    d = -0.510545944956, -2.886037030662, 1.179814300887
    return certify("xarm6", from_poe(H, P), (*a, *b), (*c, *d))


@cache
def raghavan_roth() -> PathCertificate:
    """Raghavan and Roth's arm, no two of whose axes meet or are parallel."""
    robot = from_dh(
        [0.8, 1.2, 0.33, 1.8, 0.6, 2.2],
        [0.9, 3.7, 1.0, 0.5, 2.1, 0.63],
        [20, 31, 45, 81, 12, 100],
    )
    a = 0.194807367669, 0.311656019106, 2.321367544735
    b = 2.896323486003, 2.196084224975, 2.655462619593
    c = 0.613236966041, -1.203424064048, -1.615099729776
    d = 2.944070918524, -2.390269967992, -0.374166479049
    return certify("raghavan_roth", robot, (*a, *b), (*c, *d))


ARMS = {
    make.__name__: make
    for make in (
        *(issac, sliding, jaco_gen2, crx, gofa, jaco2, xarm6),
        raghavan_roth,
    )
}


@cache
def with_offset() -> PathCertificate:
    """The ISSAC arm with theta2 = q2 + pi/2: det J is 0 at q2 = q3 = 0, exactly.

    On the line q2 = t, q3 = -t the factor c2 c3 - 2 c2 s3 - s3 is
    sin t (1 - cos t - 2 sin t) = -2 t^2 + ...: the line touches {det J = 0} at t = 0
    and does not cross it. The postures are not a couple; only the path is of use.
    """
    arm = issac()
    first, second, third = arm.joints
    second = replace(second, before=(*second.before, Rotate(Z, Fraction(1, 2))))
    return replace(arm, joints=(first, second, third))


def moved(
    arm: PathCertificate, index: int, joint: int, by: Fraction
) -> PathCertificate:
    """One posture with one joint value moved, and the end of the path with it."""
    postures, path = list(arm.postures), list(arm.path)
    row = list(postures[index])
    row[joint] += by
    postures[index] = path[-index] = tuple(row)
    first, second = postures
    return replace(arm, postures=(first, second), path=tuple(path))


def through(arm: PathCertificate, *points: Sequence[Fraction]) -> PathCertificate:
    """The path by way of other points."""
    first, second = arm.postures
    return replace(arm, path=(first, *map(tuple, points), second))


def middle(arm: PathCertificate) -> tuple[Fraction, ...]:
    """The middle of the straight segment between the two postures."""
    return tuple((x + y) / 2 for x, y in zip(*arm.postures, strict=True))


def excursion(
    arm: PathCertificate, direction: Sequence[float], past: Fraction
) -> PathCertificate:
    """To the middle, on along a ray to ``past`` the first singularity, and back."""
    start = np.array([float(x) for x in middle(arm)])
    ray = np.array(direction) / np.linalg.norm(direction)
    low, high = 0.0, 0.01
    while arm.sign * det(arm, start + high * ray) > 0:
        low, high = high, high + 0.01
    for _ in range(60):
        half = (low + high) / 2
        if arm.sign * det(arm, start + half * ray) > 0:
            low = half
        else:
            high = half
    length = Fraction(low) + past
    point = [x + Fraction(r) * length for x, r in zip(middle(arm), ray, strict=True)]
    return through(arm, middle(arm), point, middle(arm))


def rebuilt(
    arm: PathCertificate, index: int, place: int, motion: Motion
) -> PathCertificate:
    """The arm with another motion at one place before one joint."""
    joints = list(arm.joints)
    before = list(joints[index].before)
    before[place] = motion
    joints[index] = replace(joints[index], before=tuple(before))
    return replace(arm, joints=tuple(joints))
