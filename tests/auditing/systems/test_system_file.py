"""System files are read as they are documented, and refused with a reason."""

from __future__ import annotations

from pathlib import Path

import pytest

from cuspaudit.auditing.systems.file import read_system
from cuspaudit.errors import InvalidSystemError

DOCUMENTED = """\
variables: [c2, s2, c3, s3]
equations: ["c2^2 + s2^2 - 1", "c3^2 + s3^2 - 1"]     # f; may be empty
map: ["(c2*(3*c3+4)/2 + 1)^2 + (3*s3+2)^2/4", "-s2*(3*c3+4)/2"]   # R
"""


def test_the_example_of_the_interface(tmp_path: Path) -> None:
    """The documented example, the ISSAC arm, is two circles and a map to the plane."""
    file = tmp_path / "issac.yaml"
    file.write_text(DOCUMENTED)
    system = read_system(file)
    assert system.name == "issac"
    assert system.variety.ring.variables == ("c2", "s2", "c3", "s3")
    assert [str(f) for f in system.variety.equations] == [
        "c2^2 + s2^2 - 1",
        "c3^2 + s3^2 - 1",
    ]
    assert str(system.mapping.components[1]) == "-3/2*s2*c3 - 2*s2"


@pytest.mark.parametrize("equations", ["equations: []\n", "equations:\n", ""])
def test_no_equations_is_all_of_space(tmp_path: Path, equations: str) -> None:
    """V = R^n when there is no equation, whether the key is written or not."""
    file = tmp_path / "fold.yaml"
    file.write_text(f"variables: [x, y]\n{equations}map: [x^2, y]\n")
    assert read_system(file).variety.equations == ()


@pytest.mark.parametrize(
    ("text", "where"),
    [
        ("variables: [x, x]\nmap: [x]\n", "variables"),
        ("variables: [x y]\nmap: [x]\n", "variables"),
        ("variables: x\nmap: [x]\n", "variables"),
        ("variables: []\nmap: [x]\n", "variables"),
        ("variables: [x]\n", "map"),
        ("variables: [x]\nmap: [x, z]\n", "map[1]"),
        ("variables: [x]\nequations: [1/0]\nmap: [x]\n", "equations[0]"),
        ("variables: [x]\nmap: [x]\njoints: 3\n", "joints"),
        ("variables: [x]\nmap: [x]\nexpect: {verdict: maybe}\n", "verdict"),
        ("variables: [x]\nmap: [{a: x}]\n", "map"),
        ("- x\n- y\n", "mapping"),
        ("a: &b [*b]\n", "anchor"),
        ("x: [\n", ""),
        ("map: ['" + "x+" * 600_000 + "x']", "bytes"),
    ],
)
def test_a_malformed_file_is_one_line(tmp_path: Path, text: str, where: str) -> None:
    """A malformed file is refused in one line with the file and the place."""
    file = tmp_path / "bad.yaml"
    file.write_text(text)
    with pytest.raises(InvalidSystemError) as caught:
        read_system(file)
    message = str(caught.value)
    assert message.startswith(str(file))
    assert where in message
    assert "\n" not in message


def test_a_missing_file_is_one_line(tmp_path: Path) -> None:
    """A file that is not there is an input error."""
    with pytest.raises(InvalidSystemError, match="No such file"):
        read_system(tmp_path / "none.yaml")
