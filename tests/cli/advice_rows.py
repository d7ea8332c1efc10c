r"""Bad inputs whose message gives advice, and the same with the advice followed.

Each row has a command that is refused, what the message advises (a pattern, whose
groups may stand in the second command as \1), and the command that follows it. Files
are written first; those of the advice are written after the first command.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

__all__ = ["ELSEWHERE", "FILES", "NOTES", "ROWS", "Row"]

Joint = tuple[str, str, str, str]


@dataclass(frozen=True)
class Row:
    """A refusal and what follows its advice.

    Attributes:
        command: words of the command that is refused.
        advice: a pattern of what the message says.
        then: words of the command that follows it.
        writes: files that the advice asks for, by name.
        code: exit codes that are "further"; by default all but bad input.
    """

    command: str
    advice: str
    then: str
    writes: Mapping[str, str] = field(default_factory=dict)
    code: tuple[int, ...] = (0, 1, 3)


def urdf(joints: Sequence[Joint], extra: str = "") -> str:
    """A URDF of a chain of links; a joint is its type, parent, xyz and axis."""
    links, rows = ['<link name="base"/>'], []
    for k, (kind, parent, xyz, axis) in enumerate(joints, 1):
        links.append(f'<link name="l{k}"/>')
        rows.append(
            f'<joint name="j{k}" type="{kind}"><parent link="{parent}"/>'
            f'<child link="l{k}"/><origin xyz="{xyz}"/><axis xyz="{axis}"/></joint>'
        )
    return f'<robot name="arm">{"".join(links + rows)}{extra}</robot>'


def _fixed(name: str, parent: str, xyz: str) -> str:
    return (
        f'<link name="{name}"/><joint name="to_{name}" type="fixed">'
        f'<parent link="{parent}"/><child link="{name}"/><origin xyz="{xyz}"/></joint>'
    )


_TURN = "continuous"
_ELBOW: list[Joint] = [
    (_TURN, "base", "0 0 0", "0 0 1"),
    (_TURN, "l1", "0 0 0.4", "0 1 0"),
    (_TURN, "l2", "0 0 0.5", "0 1 0"),
]
_WRIST: list[Joint] = [
    (_TURN, "l3", "0 0 0.4", "0 0 1"),
    (_TURN, "l4", "0 0 0", "0 1 0"),
    (_TURN, "l5", "0 0 0", "0 0 1"),
]
_SEVEN: list[Joint] = [*_ELBOW, *_WRIST, (_TURN, "l6", "0 0.1 0.1", "0 1 0")]
_TWO_ENDS = urdf(
    [*_ELBOW, (_TURN, "base", "0 1 0", "0 0 1"), (_TURN, "l4", "0 0 0.4", "0 1 0")],
    _fixed("hand", "l3", "0 0 0.3") + _fixed("foot", "l5", "0 0 0.3"),
)
_POINTS = _fixed("left", "l3", "0 0.1 0.3") + _fixed("right", "l3", "0 -0.1 0.3")
_TABLE = "a,alpha,d,theta\n0,90,0.4,0\n0.5,0,0,0\n0.4,0,0,0\n"
_DEGENERATE = """\
convention: standard
units: m
joints: [{a: 0, alpha: pi/2, d: 1}, {a: 1, alpha: 0, d: 0}, {a: 0, alpha: 0, d: 0}]
"""
_FIVE = """\
convention: modified
units: m
joints:
  - {type: P, alpha: 0, a: 0, theta: 0}
  - {alpha: 0, a: 2, d: 0, theta: 0}
  - {alpha: pi/2, a: 0, d: 1, theta: 0}
  - {alpha: pi/2, a: 0, d: 0, theta: 0}
  - {alpha: -pi/2, a: 0, d: 3, theta: 0}
"""
_FAMILY = """\
family: small
robot:
  convention: standard
  units: m
  task: position
  joints:
    - {type: revolute, a: 1, alpha: -pi/2, d: 0}
    - {type: revolute, a: a2, alpha: pi/2, d: d2}
    - {type: revolute, a: a3, alpha: 0, d: 0}
parameters: {a2: {values: [1, 2]}, d2: {values: [0, 1]}, a3: {values: [1, 3/2]}}
"""
_SYSTEM = "variables: [x]\nmap: [x^2]\n"
_XACRO = (
    '<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">'
    '<xacro:property name="a" value="0.5"/>'
    + urdf(_ELBOW).partition(">")[2].replace("0 0 0.5", "0 0 ${a}")
)
_XACRO = _XACRO.replace("</robot>", _fixed("tip", "l3", "0 0 0.3") + "</robot>")
_MJCF_ELBOW = """\
<mujoco><worldbody><body name="a"><joint name="j1" axis="0 0 1"/>
<body name="b"><joint name="j2" axis="0 1 0"/>
<body name="c" pos="0 0 0.7"><joint name="j3" axis="0 1 0"/>
<site name="grip" pos="0 0 0.5"/></body></body></body></worldbody></mujoco>
"""
_SLIDES = urdf(
    [
        ("prismatic", "base", "0 0 0", "1 0 0"),
        *[
            (kind, f"l{k}", xyz, axis)
            for k, (kind, _, xyz, axis) in enumerate([*_ELBOW, *_WRIST], 1)
        ],
    ]
)

FILES = {
    "elbow.urdf": urdf(_ELBOW, _fixed("tip", "l3", "0 0 0.3")),
    "bare.urdf": urdf(_ELBOW),
    "beside.urdf": urdf(
        _ELBOW, _fixed("on", "l3", "0 0.2 0") + _fixed("off", "on", "0 0 0.3")
    ),
    "six.urdf": urdf([*_ELBOW, *_WRIST]),
    "seven.urdf": urdf(_SEVEN),
    "eight.urdf": urdf([*_SEVEN, (_TURN, "l7", "0 0.1 0.1", "1 0 0")]),
    "rail.urdf": _SLIDES,
    "two.urdf": _TWO_ENDS,
    "points.urdf": urdf(_ELBOW, _POINTS),
    "roots.urdf": urdf(_ELBOW, _fixed("tip", "l3", "0 0 0.3")).replace(
        "</robot>",
        '<link name="island"/><link name="shore"/><joint name="bridge" type="floating">'
        '<parent link="island"/><child link="shore"/></joint></robot>',
    ),
    "xacro.urdf": _XACRO,
    "bare.csv": _TABLE,
    "wrong.yaml": _DEGENERATE,
    "arm.yaml": _DEGENERATE + "tool: [move 0.1 0 0]\n",
    "five.yaml": _FIVE,
    "family.yaml": _FAMILY,
    "system.yaml": _SYSTEM,
    "elbow.xml": _MJCF_ELBOW,
    "jaw.urdf": urdf([*_ELBOW, *_WRIST, (_TURN, "l6", "0 0 0.1", "1 0 0")]).replace(
        "j7", "jaw"
    ),
    "turns.yaml": _DEGENERATE.replace("}", ", limits: [-400 rad, 400 rad]}")
    + "tool: [move 0.5 0 0.1]\n",
    "places.csv": "x,y,z\n0.3,0,0.3\n0.3,0.1,0.3\n",
    "audit.json": json.dumps({"schema": "cuspaudit/audit/2", "robot": None}),
}
_ROBOT3 = "chablat-2022-3r"

ROWS = (
    # the chain that is meant
    Row("audit two.urdf", r"choose one: (--tip \S+) \(3 joints", r"audit two.urdf \1"),
    Row("audit points.urdf", r"choose one: (--tip left)", r"audit points.urdf \1"),
    Row(
        "audit roots.urdf",
        r"(base).*choose one by --base LINK",
        r"audit roots.urdf --base \1",
    ),
    Row(
        "audit elbow.urdf --base l1 --tip base",
        "choose a --base on the way to the root",
        "audit elbow.urdf --base base --tip tip",
    ),
    Row(
        "audit elbow.urdf --base l3 --tip tip",
        "choose another --tip or --base",
        "audit elbow.urdf --base base --tip tip",
    ),
    Row(
        "audit elbow.xml --base c --tip a",
        "choose a --base on the way to the world",
        "audit elbow.xml --base world --tip grip",
    ),
    Row("audit elbow.xml", r"give (--tip grip)", r"audit elbow.xml \1"),
    Row("audit beside.urdf --tip l3", r"give (--tip off)", r"audit beside.urdf \1"),
    Row(
        "audit bare.urdf",
        r"fix a link at (\S+ \S+ \S+) on l3, off that axis, and give "
        "it by --tip",
        "audit fixed.urdf --tip there",
        {"fixed.urdf": urdf(_ELBOW, _fixed("there", "l3", r"\1"))},
    ),
    Row("audit jaw.urdf", r"choose one: (--tip l6) \(6 joints", r"audit jaw.urdf \1"),
    # the task and the joints to lock
    Row(
        "postures seven.urdf --joints 1,1,1,1,1,1,1",
        r"lock one of \"(j\d)\".* by --lock JOINT=VALUE",
        r"postures seven.urdf --joints 1,1,1,1,1,1 --lock \1=0 --timeout 0",
    ),
    Row("audit eight.urdf", r"give (--lock \S+ --lock \S+)", r"audit eight.urdf \1"),
    Row("audit six.urdf --task position", r"give (--task pose)", r"audit six.urdf \1"),
    Row("audit five.yaml", r"give (--task position-and-x-axis)", r"audit five.yaml \1"),
    Row(
        "audit wrong.yaml",
        r"tool: (\[[^]]*\])",
        "audit tooled.yaml",
        {"tooled.yaml": _DEGENERATE + "tool: \\1\n"},
    ),
    Row(
        "audit rail.urdf --free j1",
        "name a joint that turns, or lock it by --lock",
        "audit rail.urdf --lock j1=0",
    ),
    # tables
    Row(
        "audit bare.csv",
        r"(--convention standard)\|modified (--angle-unit deg)\|rad "
        r"(--length-unit m)\|mm",
        r"audit bare.csv \1 \2 \3",
    ),
    Row(
        "audit elbow.urdf --convention standard",
        "leave out --convention",
        "audit elbow.urdf",
    ),
    # files of another kind
    Row("audit .", r"type: cuspaudit (check \.)", "check ."),
    Row(
        "audit xacro.urdf",
        "end its name in .xacro",
        "audit named.xacro",
        {"named.xacro": _XACRO},
    ),
    Row("audit system.yaml", r"type: cuspaudit (decide system.yaml)", r"\1"),
    Row(
        "audit family.yaml",
        r"type: cuspaudit (sweep -o) DIR (family.yaml)",
        r"\1 swept \2",
    ),
    Row("decide arm.yaml", r"type: cuspaudit (audit arm.yaml)", r"\1", {}),
    Row("import", "give ROBOT, or --list for the names known", f"import {_ROBOT3}"),
    Row(
        "show audit.json",
        "name the audit of a robot",
        f"show {_ROBOT3} --html page.html",
    ),
    Row(
        "audit elbow.urdf --snap strict",
        "give --snap none, default or a YAML file",
        "audit elbow.urdf --snap none",
    ),
    # options beside another
    Row(
        "audit two.urdf --all --tip hand",
        "leave out (--tip), or leave out --all",
        "audit two.urdf --all",
    ),
    Row(
        "audit seven.urdf --free j3 --certificate c.json",
        r"give --json FILE",
        "audit seven.urdf --free j3 --timeout 1 --json free.json",
    ),
    # poses and paths
    Row(
        f"postures {_ROBOT3}",
        r"give --joints Q1,\.\.\. or --position X,Y,Z",
        f"postures {_ROBOT3} --position 2,0,0.5",
    ),
    Row(
        "postures ur5 --position 0.4,0,0.3",
        "add --quaternion W,X,Y,Z or --rpy R,P,Y",
        "postures ur5 --position 0.4,0,0.3 --rpy 0,0,0",
    ),
    Row(
        "postures ur5 --position 0.4,0,0.3 --rpy 0,0,0 --quaternion 1,0,0,0",
        "--quaternion and --rpy; give one",
        "postures ur5 --position .4,0,.3 --rpy 0,0,0",
    ),
    Row(
        f"postures {_ROBOT3} --joints 90,0,10",
        r"write (90 deg)",
        f"postures {_ROBOT3} --joints 90deg,0,10deg",
    ),
    Row(
        "trace ur5 places.csv",
        r"give the columns qw,qx,qy,qz",
        "trace ur5 poses.csv",
        {"poses.csv": "x,y,z,qw,qx,qy,qz\n.4,0,.3,0,1,0,0\n.4,.01,.3,0,1,0,0\n"},
    ),
    # families
    Row(
        "plot nothing -o p.svg", "did you mean|give a file", f"plot {_ROBOT3} -o p.svg"
    ),
    Row(
        "plot . -o p.svg",
        "name the DIR of cuspaudit sweep FAMILY.yaml -o DIR",
        "plot swept -o p.svg --fix a3=1",
    ),
    Row("plot swept -o p.svg", r"(--fix \S+)", r"plot swept -o p.svg \1"),
    Row(
        "plot swept -o p.svg --fix a3=7",
        "leave out --fix, or sweep on",
        "plot swept -o p.svg --fix a3=1",
    ),
    Row(
        "plot swept -o p.svg --fix a3=1 --audit 0",
        "end the name in .html, or leave out --audit",
        "plot swept -o p.html --fix a3=1 --audit 0",
    ),
    Row(
        "sweep family.yaml -o other --timeout 9 --scheduler tcp://x:1",
        "leave out --timeout, or leave out --scheduler",
        "sweep family.yaml -o other --timeout 9",
    ),
)

#: commands that are not refused, what they say in passing, and what follows it
NOTES = (
    Row("import elbow.xml", r"may be the tip: (--tip grip)", r"audit elbow.xml \1"),
    Row(
        "audit seven.urdf --timeout 0",
        r"(--free) JOINT covers all values of one, --lock JOINT=VALUE takes one",
        r"audit seven.urdf \1 j3 --timeout 1",
    ),
    Row(
        "trace turns.yaml places.csv",
        r"more than 10000 windings; (--no-limits)",
        r"trace turns.yaml places.csv \1",
    ),
)

#: advice that is followed by a test of its own, or that a test cannot follow
ELSEWHERE = {
    "cuspaudit setup": "tests/algebra/test_msolve_setup.py",
    "uv pip install": "tests/algebra/test_msolve_setup.py",
    "cuspaudit[cluster]": "needs an environment without it",
    "cuspaudit[xacro]": "needs an environment without it",
    "git lfs pull": "needs the repository that the file came from",
    "install cuspaudit again": "needs a broken installation",
    "xacro FILE > robot.urdf": "tests/cli/test_advice_followed.py",
    "mj_saveLastXML": "tests/robot/formats/mjcf/test_mjcf.py",
    "--package NAME=DIR": "tests/cli/test_robot_options.py",
    "--xacro-arg NAME=VALUE": "tests/cli/test_robot_options.py",
    "may be the tip": "tests/cli/test_advice_followed.py",
    "--timeout 600": "a page's, whose command is that of the audit",
    "--no-limits": "tests/cli/test_advice_followed.py",
    "covers all values of one": "tests/cli/test_advice_followed.py",
    "audit --free": "the name of a command, beside its advice",
    "--debug shows": "tests/cli/test_last_door.py",
}
