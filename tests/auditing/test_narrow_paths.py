"""Paths that are proved in balls, and too narrow for floating point to see."""

from __future__ import annotations

from pathlib import Path

from cuspaudit.auditing.audit import audit
from cuspaudit.auditing.options import Options
from cuspaudit.robot.library import open_robot

ROWS = (
    ("0 0 0.0239809816", "1.62560773 -0.718180889 2.87865591"),
    (
        "-0.0171454888 -0.0172082098 -0.00580362883",
        "-2.5612276 0.0348809938 -0.259026677",
    ),
    ("-0.667900319 -0.260849609 -0.11665297", "-3.07487565 0.875657296 0.138493697"),
)
AXES = (
    "0.658015964 0.75187314 -0.0412525448",
    "-0.185296392 0.484336061 0.855034401",
    "0.518492513 -0.38041163 0.765801871",
)
TIP = ("-0.154983006 0.0776781695 0.416842556", "-0.0609122242 -0.696293458 2.60341675")


def urdf() -> str:
    """An arm whose axes 1 and 2 meet, with link frames at random and nine digits."""
    lines = ['<robot name="narrow"><link name="l0"/>']
    for k, ((xyz, rpy), axis) in enumerate(zip(ROWS, AXES, strict=True), 1):
        lines += [
            f'<link name="l{k}"/><joint name="j{k}" type="continuous">',
            f'<parent link="l{k - 1}"/><child link="l{k}"/>',
            f'<origin xyz="{xyz}" rpy="{rpy}"/><axis xyz="{axis}"/></joint>',
        ]
    xyz, rpy = TIP
    lines += [
        '<link name="tip"/><joint name="tool" type="fixed"><parent link="l3"/>',
        f'<child link="tip"/><origin xyz="{xyz}" rpy="{rpy}"/></joint></robot>',
    ]
    return "\n".join(lines)


def test_a_hair_of_the_literal_numbers_does_not_fail_the_audit(tmp_path: Path) -> None:
    """The snapped arm has its verdict, the literal path a proof and no cross-check."""
    file = tmp_path / "narrow.urdf"
    file.write_text(urdf())
    found = audit(open_robot(file, task="position"), Options())
    assert found.verdict.value == "noncuspidal"
    witness = found.record()["literal_witness"]
    assert witness is not None
    assert witness["clearance"] < 1e-10
    assert found.check.path_points_checked == 0
    assert found.check.agree
