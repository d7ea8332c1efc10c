from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest
from flint import fmpq

import cuspaudit
from cuspaudit.algebra.msolve import msolve_text, parse_real_solutions, run_msolve
from cuspaudit.errors import UnableError
from cuspaudit.kinematics.exact_model import ExactModel, exact_model
from cuspaudit.kinematics.export import inverse_kinematics, msolve_system, poly_text
from cuspaudit.kinematics.polynomial_map import polynomial_map
from cuspaudit.robot.chain import X_AXIS, Angle, Rotation
from cuspaudit.robot.formats.read_robot import read_robot

ROBOTS = Path(cuspaudit.__file__).parents[1] / "robots"


def model_of(name: str) -> ExactModel:
    """The exact model of a robot of the library."""
    return exact_model(read_robot(ROBOTS / f"{name}.yaml").chain)


def centres(text: str) -> list[list[float]]:
    """The middles of the boxes msolve returns for ``text``."""
    boxes = parse_real_solutions(run_msolve(text, timeout=20))
    return [[float((a + b) / 2) for a, b in box] for box in boxes]


def test_the_polynomials_are_printed_with_det_j_factored() -> None:
    """f, R and det J are shown, det J by its factors."""
    text = poly_text(model_of("chablat-2022-3r-mirror"))
    assert "  c2^2 + s2^2 - 1 = 0\n" in text
    assert "  z = -3/2*s2*c3 - 2*s2\n" in text
    assert text.endswith("constant\n  3*c3 + 4\n  c2*c3 - 2*c2*s3 - s3\n")
    assert "r11" not in text
    assert "  r33 = " in poly_text(model_of("ur5"))


def test_a_zero_offset_and_an_approximation_are_said() -> None:
    """What a variable means, and what is not exact, stands beside the polynomials."""
    chain = read_robot(ROBOTS / "chablat-2022-3r.yaml").chain
    turn = Rotation(chain.joints[0].axis, Angle(Fraction(-1, 2)))
    first = replace(chain.joints[0], before=(turn,))
    odd = Rotation(X_AXIS, Angle(radians=Fraction(7, 10)))
    second = replace(chain.joints[1], before=(odd, *chain.joints[1].before))
    text = poly_text(exact_model(chain.with_joints([first, second, chain.joints[2]])))
    assert "c1, s1 = cos, sin(theta1 - pi/2) of joint 1" in text
    assert "angle: within 1e-12 rad" in text


def test_the_issac_arm_has_four_postures_at_the_published_point() -> None:
    """From f and R - (2.5, 0, 0.5) msolve returns the four published postures."""
    model = model_of("chablat-2022-3r-mirror")
    mapping = polynomial_map(model)
    point = (fmpq(5, 2), 0, fmpq(1, 2))
    rest = [r - p for r, p in zip(mapping.position.components, point, strict=True)]
    found = centres(msolve_text(model.ring, [*mapping.variety.equations, *rest]))
    sines = sorted(round(row[3], 4) for row in found)
    assert sines == [-0.6249, -0.3234, -0.3126, -0.1447]


def test_an_arm_over_a_quadratic_field_reaches_its_place() -> None:
    """With sqrt 3 > 0 the rational posture is found again; det J is printed over it."""
    model = model_of("salunkhe-2022-fig20a")
    assert "# sqrt3 = the positive root" in poly_text(model)
    system = inverse_kinematics(model, seed=1)
    assert all(p.degrees()[-1] <= 1 for p in system.equations)
    wanted = [float(system.posture[v]) for v in model.ring.variables] + [3**0.5]
    found = [row for row in centres(msolve_system(model, seed=1)) if row[-1] > 0]
    assert 2 <= len(found) <= 4
    gaps = [max(abs(a - b) for a, b in zip(r, wanted, strict=True)) for r in found]
    assert min(gaps) < 1e-12


def test_a_slide_is_one_free_variable() -> None:
    """A sliding joint has no circle, and a rational value in the system."""
    chain = read_robot(ROBOTS / "chablat-2022-3r.yaml").chain
    joints = [*chain.joints[:2], replace(chain.joints[2], kind="prismatic")]
    model = exact_model(chain.with_joints(joints))
    assert "q3 = displacement of joint 3" in poly_text(model)
    system = inverse_kinematics(model)
    assert len(system.equations) == 2 + 3
    found = centres(msolve_system(model))
    wanted = float(system.posture["q3"])
    assert min(abs(row[-1] - wanted) for row in found) < 1e-12


@pytest.mark.parametrize(("name", "most"), [("chablat-2022-3r", 4), ("ur5", 8)])
def test_msolve_reads_our_file_and_finds_the_posture(name: str, most: int) -> None:
    """The rational posture the system was made from is among msolve's solutions."""
    model = model_of(name)
    system = inverse_kinematics(model, seed=3)
    found = centres(msolve_system(model, seed=3))
    wanted = [float(system.posture[v]) for v in model.ring.variables]
    assert any(
        max(abs(a - b) for a, b in zip(row, wanted, strict=True)) < 1e-12
        for row in found
    )
    assert len(found) in range(2, most + 1, 2)


def test_a_pose_task_has_twelve_equations_beside_the_circles() -> None:
    """Position gives three equations, rotation nine more."""
    assert len(inverse_kinematics(model_of("ur5")).equations) == 6 + 12
    assert len(inverse_kinematics(model_of("chablat-2022-3r")).equations) == 3 + 3


def test_the_seed_chooses_the_posture() -> None:
    """The same seed gives the same file, another seed another one."""
    model = model_of("chablat-2022-3r")
    assert msolve_system(model, 5) == msolve_system(model, 5)
    assert msolve_system(model, 5) != msolve_system(model, 6)


def test_a_task_that_is_not_square_has_no_msolve_file() -> None:
    """Three joints for a pose leave no zero-dimensional system to write."""
    chain = replace(read_robot(ROBOTS / "chablat-2022-3r.yaml").chain, task="pose")
    with pytest.raises(UnableError, match="3 joints for a pose task"):
        msolve_system(exact_model(chain))
