from __future__ import annotations

from pathlib import Path

import pytest

from cuspaudit.errors import InvalidRobotError
from cuspaudit.robot.formats.read_robot import chains_in, read_robot
from cuspaudit.robot.formats.xacro.expressions import refusal

pytest.importorskip("xacrodoc")

ARM = """\
<?xml version="1.0"?>
<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="$(find my_description)/lengths.xacro"/>
  <xacro:property name="half" value="${pi/2}"/>
  <xacro:macro name="link_and_joint" params="n parent xyz rpy">
    <link name="l${n}"/>
    <joint name="j${n}" type="continuous"><parent link="${parent}"/>
      <child link="l${n}"/><origin xyz="${xyz}" rpy="${rpy}"/><axis xyz="0 0 1"/>
    </joint>
  </xacro:macro>
  <link name="base"/><link name="tip"/>
  <xacro:link_and_joint n="1" parent="base" xyz="0 0 ${a/2}" rpy="0 0 0"/>
  <xacro:link_and_joint n="2" parent="l1" xyz="${a} 0 0" rpy="${half} 0 0"/>
  <xacro:link_and_joint n="3" parent="l2" xyz="${2*a} 0 ${a}" rpy="${-half} 0 0"/>
  <joint name="t" type="fixed"><parent link="l3"/><child link="tip"/>
    <origin xyz="${1.5*a} 0 0"/></joint>
</robot>
"""
LENGTHS = """\
<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="a" value="0.5"/>
</robot>
"""


def write(folder: Path, text: str = ARM) -> tuple[Path, dict[str, str]]:
    """A xacro file and the package that it finds by name."""
    package = folder / "elsewhere" / "description"
    package.mkdir(parents=True, exist_ok=True)
    (package / "lengths.xacro").write_text(LENGTHS)
    path = folder / "here" / "arm.xacro"
    path.parent.mkdir(exist_ok=True)
    path.write_text(text)
    return path, {"my_description": str(package)}


def test_a_xacro_file_is_read_as_what_it_expands_to(tmp_path: Path) -> None:
    """Macros, properties and an include from a package give the chain, with a note."""
    path, packages = write(tmp_path)
    robot = read_robot(path, packages=packages)
    assert robot.chain.kinds == ("revolute",) * 3
    assert [float(x) for x in robot.chain.tool[0].vector] == [0.75, 0, 0]
    assert robot.notes[0].startswith("expanded by xacro")
    assert (robot.file, robot.urdf) == (str(path), None)
    assert [one.tip for one in chains_in(path, packages=packages)] == ["tip"]


def test_a_package_that_is_not_named_is_asked_for(tmp_path: Path) -> None:
    """The message says how to name its folder; following it, the file reads."""
    path, packages = write(tmp_path)
    with pytest.raises(InvalidRobotError, match="name its folder by --package"):
        read_robot(path)
    assert read_robot(path, packages=packages).chain.joints
    with pytest.raises(InvalidRobotError, match=r"no folder .* for the package"):
        read_robot(path, packages={"my_description": str(tmp_path / "nowhere")})


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (
            "${().__class__.__bases__[0].__subclasses__()}",
            "holds a call of something else",
        ),
        ("${open('/etc/passwd').read()}", "holds a call of"),
        ("${[x for x in range(9)]}", "holds a ListComp"),
        ("${9**9**9}", "holds a power"),
        ("${'a' * 10000000000}", "holds a power or a repetition"),
        ("$(eval 1 + 1)", "is not evaluated"),
        ("${xacro.load_yaml('/etc/passwd')}", "it opens ./etc/passwd., outside"),
        ("${nothing}", "nothing"),
    ],
)
def test_a_hostile_expression_is_not_evaluated(
    tmp_path: Path, change: str, said: str
) -> None:
    """Code, files elsewhere and huge numbers are refused on one line."""
    path, packages = write(tmp_path, ARM.replace("${pi/2}", change))
    with pytest.raises(InvalidRobotError, match=said) as caught:
        read_robot(path, packages=packages)
    assert "\n" not in str(caught.value)
    assert "root:" not in str(caught.value)


def test_an_include_from_elsewhere_is_refused(tmp_path: Path) -> None:
    """A file outside the folder and the packages is not opened."""
    (tmp_path / "secret.xacro").write_text(LENGTHS)
    outside = ARM.replace("$(find my_description)/lengths", str(tmp_path / "secret"))
    path, packages = write(tmp_path, outside)
    with pytest.raises(InvalidRobotError, match="outside the folders given"):
        read_robot(path, packages=packages)


def test_errors_of_the_urdf_name_the_xacro_file(tmp_path: Path) -> None:
    """What is wrong with the expanded file is said of the file that was given."""
    path, packages = write(tmp_path, ARM.replace('link="tip"', 'link="top"', 1))
    with pytest.raises(InvalidRobotError, match="is not declared") as caught:
        read_robot(path, packages=packages)
    assert str(caught.value).startswith(f"{path}: joint")


def test_arithmetic_is_evaluated() -> None:
    """What robots need passes: arithmetic, choices, items, functions by name."""
    for text in ("2*pi/3", "-a if left else a", "props['x'][0]", "math.sin(0.5)**2"):
        assert refusal(text) is None
    for text in ("lambda: 0", "x.__dict__", "f(x)", "'{}'.format(x)", "a := 1", "["):
        assert refusal(text) is not None


ASKING = """\
<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="lift" default="0.25"/>
  <link name="base"/><link name="tip"/>
  <joint name="j" type="continuous"><parent link="base"/><child link="tip"/>
    <origin xyz="$(arg length) 0 $(arg lift)"/><axis xyz="0 0 1"/></joint>
</robot>
"""


def test_arguments_are_given_by_name_and_asked_for(tmp_path: Path) -> None:
    """A missing one is asked for by its option; a name that is not there is refused."""
    path = tmp_path / "arm.xacro"
    path.write_text(ASKING)
    with pytest.raises(InvalidRobotError, match=r'"length" has no value.*--xacro-arg'):
        read_robot(path)
    robot = read_robot(path, xacro_args={"length": "${2 * 0.5}"})
    [step] = robot.chain.joints[0].before
    assert [float(x) for x in step.vector] == [1, 0, 0.25]
    assert robot.notes[0] == "expanded by xacro, length=${2 * 0.5}"
    given = {"length": "1", "lfit": "2"}
    with pytest.raises(InvalidRobotError, match='no argument is named "lfit"; it asks'):
        read_robot(path, xacro_args=given)
    with pytest.raises(InvalidRobotError, match="holds a call of"):
        read_robot(path, xacro_args={"length": "${open('/etc/passwd')}"})
