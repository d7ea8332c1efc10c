from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from cuspaudit.auditing.crosscheck import compare as module
from cuspaudit.auditing.crosscheck.compare import (
    CrossCheck,
    crosscheck,
    singular_postures,
)
from cuspaudit.auditing.crosscheck.pinocchio_model import arm_from_chain, reach_scale
from cuspaudit.errors import CrossCheckError
from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.exact_model import exact_model
from cuspaudit.robot.chain import (
    X_AXIS,
    Z_AXIS,
    Angle,
    Chain,
    Joint,
    Motion,
    Rotation,
    Task,
    Translation,
)
from cuspaudit.robot.formats.urdf.read import read_urdf
from cuspaudit.robot.snapping import snap
from cuspaudit.robot.task import lock
from cuspaudit.robot.virtual_joint import TOOL_AXES

ChainOf = Callable[[str], Chain]

# a published nonsingular path, theta1 being free
PATH = [[0.2, t2, t3] for t2, t3 in np.linspace([-0.742, 2.628], [-3.0, -0.5], 12)]
ARMS = (
    *("chablat-2022-3r", "chablat-2022-3r-mirror", "ark-2022-3r", "ur5"),
    *("salunkhe-2022-fig20a", "salunkhe-2022-fig20b", "kinova-jaco-gen2"),
    *("stanford-arm", "adept-cobra-600", "rawr-orion-5"),
)


def altered(chain: Chain, number: int, change: Callable[[Motion], Motion]) -> Chain:
    """``chain`` with the motions before joint ``number`` changed."""
    joints = list(chain.joints)
    before = tuple(change(motion) for motion in joints[number].before)
    joints[number] = replace(joints[number], before=before)
    return chain.with_joints(joints)


def mirrored(motion: Motion) -> Motion:
    """The motion with its translation reversed."""
    if isinstance(motion, Translation):
        x, y, z = motion.vector
        return Translation((-x, -y, -z))
    return motion


def six_of(seven: Path) -> tuple[Chain, dict[str, str]]:
    """A square chain of the seven-joint URDF, and what is locked in it."""
    locked = {"j2": "0.3 rad"}
    whole = read_urdf(seven, base="base", tip="tip", task="pose").chain
    return lock(whole, locked), locked


@pytest.mark.parametrize("name", ARMS)
def test_each_arm_agrees(chain_of: ChainOf, name: str) -> None:
    """Pose and det J agree to 1e-9, and the rank is lost on the singular set."""
    result = crosscheck(exact_model(chain_of(name)))
    assert result.agree
    assert result.engine == "pinocchio"
    assert result.max_relative_error <= 2e-12
    assert result.singular_points_checked == 20
    assert result.samples == 100


def test_literal_against_file_and_snapped_against_chain(seven: Path) -> None:
    """The literal model is held to the file, the snapped one to its own chain."""
    chain, locked = six_of(seven)
    snapped, record = snap(chain)
    assert record
    literal, model = exact_model(chain), exact_model(snapped)
    result = crosscheck(model, urdf=seven, literal=literal, locked=locked)
    assert result.samples == 200
    assert result.max_relative_error <= result.allowed_error < 1e-6
    with pytest.raises(CrossCheckError, match=r"seven\.urdf"):
        crosscheck(model, urdf=seven, locked=locked)


def test_the_seed_is_kept_and_repeats_the_check(chain_of: ChainOf) -> None:
    """The same seed gives the same result, another seed other postures."""
    model = exact_model(chain_of("ur5"))
    results: list[CrossCheck] = [
        crosscheck(model, samples=5, singular=(), seed=seed) for seed in (4, 4, 5)
    ]
    assert results[0] == results[1]
    assert results[0].max_relative_error != results[2].max_relative_error
    assert results[2].seed == 5


@pytest.mark.parametrize("task", TOOL_AXES)
def test_each_tool_axis_agrees(chain_of: ChainOf, task: Task) -> None:
    """Det J of six joints, one virtual, is that of Pinocchio's five."""
    chain = replace(chain_of("chablat-2022-5r"), task=task)
    assert crosscheck(exact_model(chain)).max_relative_error <= 2e-12


def test_a_rounded_scara_is_compared_as_it_is(chain_of: ChainOf) -> None:
    """Off its structure the tip has no angle, but the rows of the Jacobian stay."""
    chain = chain_of("adept-cobra-600")
    tilt = Rotation(X_AXIS, Angle(radians=Fraction(1, 10**3)))
    joints = list(chain.joints)
    joints[1] = replace(joints[1], before=(*joints[1].before, tilt))
    crosscheck(exact_model(chain), literal=exact_model(chain.with_joints(joints)))


def test_a_wrong_sign_of_one_length_is_noticed(seven: Path) -> None:
    """One translation reversed, and the file no longer agrees."""
    chain, locked = six_of(seven)
    wrong = exact_model(altered(chain, 3, mirrored))
    with pytest.raises(CrossCheckError, match="position of the exact model"):
        crosscheck(wrong, urdf=seven, locked=locked)


def test_a_wrong_axis_is_noticed(seven: Path) -> None:
    """A joint turning the other way is another arm, though its det J looks alike."""
    chain, locked = six_of(seven)
    joints = list(chain.joints)
    x, y, z = joints[-1].axis
    joints[-1] = replace(joints[-1], axis=(-x, -y, -z))
    with pytest.raises(CrossCheckError, match="differ by"):
        crosscheck(exact_model(chain.with_joints(joints)), urdf=seven, locked=locked)


def test_a_number_altered_in_its_eighth_digit_is_noticed(seven: Path) -> None:
    """A length off by 1e-8 exceeds the tolerance of 1e-9."""
    chain, locked = six_of(seven)
    tool = Translation((Fraction(1, 10**8), Fraction(0), Fraction(0)))
    off = exact_model(replace(chain, tool=(*chain.tool, tool)))
    with pytest.raises(CrossCheckError, match="position"):
        crosscheck(off, urdf=seven, locked=locked)


@pytest.mark.parametrize("factor", [-1, 2])
def test_a_wrong_determinant_is_noticed(
    chain_of: ChainOf, monkeypatch: pytest.MonkeyPatch, factor: int
) -> None:
    """The polynomial has Pinocchio's det J in value and in sign."""
    monkeypatch.setattr(
        module, "jacobian_determinant", lambda m: factor * jacobian_determinant(m)
    )
    with pytest.raises(CrossCheckError, match="det J"):
        crosscheck(exact_model(chain_of("chablat-2022-3r")))


def test_a_posture_off_the_singular_set_is_noticed(chain_of: ChainOf) -> None:
    """1e-5 rad away from det J = 0 Pinocchio keeps its rank."""
    model = exact_model(chain_of("chablat-2022-3r"))
    singular = singular_postures(model, 4)
    assert crosscheck(model, singular=singular).singular_points_checked == 4
    with pytest.raises(CrossCheckError, match="keeps its rank"):
        crosscheck(model, singular=[singular[0] + [0, 1e-5, 0]])


def test_the_published_path_is_nonsingular(chain_of: ChainOf) -> None:
    """Along the path of the paper det J keeps its sign, at way points and between."""
    model = exact_model(chain_of("chablat-2022-3r-mirror"))
    assert crosscheck(model, path=PATH).path_points_checked == 23


def test_a_path_through_a_singularity_is_noticed(chain_of: ChainOf) -> None:
    """The postures at its ends have one sign on the mirror arm, not on this one."""
    mirror = exact_model(chain_of("chablat-2022-3r-mirror"))
    with pytest.raises(CrossCheckError, match="changes sign"):
        crosscheck(mirror, path=[*PATH, [0.2, -3.0, 2.0]])
    with pytest.raises(CrossCheckError, match="changes sign"):
        crosscheck(exact_model(chain_of("chablat-2022-3r")), path=PATH)


def test_a_path_on_the_singular_set_is_noticed(chain_of: ChainOf) -> None:
    """A way point with det J = 0 leaves no margin, whatever its rounded sign."""
    model = exact_model(chain_of("ur5"))
    (point,) = singular_postures(model, 1)
    with pytest.raises(CrossCheckError, match="witness path is singular"):
        crosscheck(model, path=[point, point])


@pytest.mark.parametrize("side", [-1e-14, 1e-14])
def test_a_path_within_rounding_of_a_singularity_is_noticed(
    chain_of: ChainOf, side: float
) -> None:
    """A |det J| that is all rounding error is no margin, its sign being one or not."""
    model = exact_model(chain_of("chablat-2022-3r"))
    point = singular_postures(model, 1)[0] + [0, side, side]
    with pytest.raises(CrossCheckError, match="witness path is singular"):
        crosscheck(model, path=[point, point])


def test_a_polynomial_of_the_wrong_sign_is_noticed_on_the_path(
    chain_of: ChainOf, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The sign that a witness claims is Pinocchio's and the polynomial's."""
    monkeypatch.setattr(
        module, "jacobian_determinant", lambda m: -jacobian_determinant(m)
    )
    model = exact_model(chain_of("chablat-2022-3r-mirror"))
    with pytest.raises(CrossCheckError, match="by the polynomial"):
        module._Comparison(model, None, None).check_path(PATH)


def test_the_path_belongs_to_the_literal_arm(chain_of: ChainOf) -> None:
    """With two models the path is held to the literal one unless said otherwise."""
    mirror, table = (
        exact_model(chain_of(name))
        for name in ("chablat-2022-3r-mirror", "chablat-2022-3r")
    )
    assert crosscheck(table, literal=mirror, path=PATH).path_points_checked == 23
    with pytest.raises(CrossCheckError, match="changes sign"):
        crosscheck(table, literal=mirror, path=PATH, path_is_literal=False)


@pytest.mark.parametrize("name", ["ur5", "fanuc-crx-10ia-l", "abb-gofa-5"])
def test_singular_postures_meet_every_factor(chain_of: ChainOf, name: str) -> None:
    """The computed postures are singular to rounding, and not all of one kind."""
    chain = chain_of(name)
    found = singular_postures(exact_model(chain), 20, seed=2)
    arm, length = arm_from_chain(chain), reach_scale(chain)
    values = [arm.at(posture).singular_values(length) for posture in found]
    assert max(row[-1] / row[0] for row in values) < 1e-9
    if name == "ur5":
        elbow = [abs(np.sin(posture[2])) < 1e-9 for posture in found]
        wrist = [abs(np.sin(posture[4])) < 1e-9 for posture in found]
        assert any(elbow) and any(wrist)
        assert not all(a or b for a, b in zip(elbow, wrist, strict=True))


def slider(middle: Joint, task_axis: Joint) -> Chain:
    """Three joints, one of them sliding."""
    turn = Rotation(X_AXIS, Angle(Fraction(1, 2)))
    one = Translation((Fraction(1), Fraction(0), Fraction(0)))
    first = Joint("j1", "revolute", axis=Z_AXIS)
    return Chain(
        "slider",
        (
            first,
            replace(middle, before=(one, turn)),
            replace(task_axis, before=(one,)),
        ),
        (one,),
    )


def test_slides_are_checked_too() -> None:
    """A sliding joint is sampled within the reach and solved for like the others."""
    slide = Joint("j2", "prismatic", axis=(Fraction(3), Fraction(0), Fraction(4)))
    turn = Joint("j3", "revolute", axis=Z_AXIS)
    for chain in (slider(slide, turn), slider(turn, replace(slide, name="j4"))):
        result = crosscheck(exact_model(chain))
        assert result.max_relative_error < 1e-12
        assert result.singular_points_checked > 0


def test_an_arm_that_is_singular_everywhere_agrees() -> None:
    """Where det J is the zero polynomial, Pinocchio finds no rank anywhere."""
    turn = Joint("j2", "revolute", axis=X_AXIS)
    again = Joint("j3", "revolute", axis=X_AXIS)
    flat = slider(turn, again)
    model = exact_model(flat)
    assert jacobian_determinant(model) == 0
    assert crosscheck(model).singular_points_checked == 20
