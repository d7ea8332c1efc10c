from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from cuspaudit.atlas.entry import failed_entry
from cuspaudit.atlas.index import index_html
from cuspaudit.atlas.site import Built, build_site
from cuspaudit.atlas.sources import robot_sources
from cuspaudit.certificate import read_certificate, verify
from cuspaudit.errors import InvalidInputError
from cuspaudit.robot.library import library

NAMES = ("anthropomorphic-offset", "chablat-2022-3r", "adept-cobra-600")
KINDS = {"structure", "path"}


@pytest.fixture(scope="module")
def robots(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with three robot files and one that is none."""
    folder = tmp_path_factory.mktemp("robots")
    known = dict(library())
    for name in NAMES:
        shutil.copy(known[name], folder)
    (folder / "broken.yaml").write_text("joints: 3\n")
    return folder


def built(robots: Path, site: Path, workers: int = 1) -> Built:
    """The site of the folder."""
    return build_site(robot_sources([str(robots)]), site, workers=workers, timeout=20)


@pytest.fixture(scope="module")
def site(robots: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The site of the folder, built once."""
    folder = tmp_path_factory.mktemp("sites") / "site"
    built(robots, folder)
    return folder


def contents(folder: Path) -> dict[str, bytes]:
    """Every file with what is in it."""
    return {
        str(p.relative_to(folder)): p.read_bytes()
        for p in sorted(folder.rglob("*"))
        if p.is_file()
    }


def test_every_arm_has_its_line_page_and_certificate(site: Path) -> None:
    """Verdicts of three arms, and the reason why a fourth file has none."""
    rows = {
        row["slug"]: row
        for row in json.loads((site / "atlas.json").read_text())["arms"]
    }
    assert set(rows) == {*NAMES, "broken"}
    assert "broken.yaml" in rows["broken"]["error"]
    verdicts = {name: rows[name]["verdict"] for name in NAMES}
    assert verdicts["chablat-2022-3r"] == "cuspidal"
    assert list(verdicts.values()).count("noncuspidal") == 2
    for name in NAMES:
        assert rows[name]["certificate"] in KINDS
        assert verify(read_certificate(site / "certificates" / f"{name}.json")).accepted
        page = (site / "arms" / f"{name}.html").read_text()
        assert "checked in your browser" in page
        assert json.loads((site / "arms" / f"{name}.json").read_text())["verdict"]
    table = (site / "index.html").read_text()
    assert all(f'href="arms/{name}.html"' in table for name in NAMES)
    assert "broken" in table


def test_the_same_robots_give_the_same_site(
    robots: Path, site: Path, tmp_path: Path
) -> None:
    """Two processes and one, from another folder name, byte for byte."""
    elsewhere = tmp_path / "elsewhere"
    built(robots, elsewhere, workers=2)
    assert contents(elsewhere) == contents(site)


def test_only_what_has_changed_is_audited(robots: Path, tmp_path: Path) -> None:
    """Nothing twice; a changed file again, a lost page again, a removed one gone."""
    own, site = tmp_path / "robots", tmp_path / "site"
    own.mkdir()
    for name in NAMES[:2]:
        shutil.copy(robots / f"{name}.yaml", own)
    assert built(own, site).made == 2
    before = contents(site)
    assert built(own, site).made == 0
    assert contents(site) == before
    file = own / f"{NAMES[0]}.yaml"
    file.write_text(file.read_text().replace("unit", "unit", 1) + "# again\n")
    assert built(own, site).made == 1
    (site / "arms" / f"{NAMES[1]}.html").unlink()
    assert built(own, site).made == 1
    file.unlink()
    assert built(own, site).made == 0
    assert not (site / "arms" / f"{NAMES[0]}.html").exists()
    assert not (site / "certificates" / f"{NAMES[0]}.json").exists()


def test_a_folder_of_something_else_is_left_alone(robots: Path, tmp_path: Path) -> None:
    """No file of another kind is written over or removed."""
    (tmp_path / "thesis.tex").write_text("years of work")
    with pytest.raises(InvalidInputError, match="not of an atlas"):
        built(robots, tmp_path)
    assert [p.name for p in tmp_path.iterdir()] == ["thesis.tex"]
    with pytest.raises(InvalidInputError, match="no robot"):
        build_site([], tmp_path / "site")


def test_a_damaged_table_is_made_again(robots: Path, tmp_path: Path) -> None:
    """Half a file of an earlier build is no reason to stop."""
    own, site = tmp_path / "robots", tmp_path / "site"
    own.mkdir()
    shutil.copy(robots / f"{NAMES[2]}.yaml", own)
    built(own, site)
    whole = contents(site)
    table = site / "atlas.json"
    table.write_text(table.read_text()[:40])
    assert built(own, site).made == 1
    assert contents(site) == whole


def test_names_and_files_may_be_mixed_and_none_comes_twice(robots: Path) -> None:
    """A name of the library is a robot; what is neither name nor file is an error."""
    one = str(robots / f"{NAMES[0]}.yaml")
    assert robot_sources(["puma-560", one, one]) == ["puma-560", one]
    assert len(robot_sources([], known=True)) >= len(library())
    assert str(robots / "broken.yaml") in robot_sources([str(robots)])
    with pytest.raises(InvalidInputError, match="no such file"):
        robot_sources(["no-such-robot"])


def test_two_files_of_one_name_have_two_pages(robots: Path, tmp_path: Path) -> None:
    """The second is numbered."""
    one, two = tmp_path / "one", tmp_path / "two"
    for folder in (one, two):
        folder.mkdir()
        (folder / "arm.yaml").write_text("joints: 3\n")
    done = build_site([str(one / "arm.yaml"), str(two / "arm.yaml")], tmp_path / "site")
    assert [entry.slug for entry in done.entries] == ["arm", "arm-2"]


def test_what_robots_say_is_text() -> None:
    """A name with markup in it is shown and does nothing."""
    page = index_html("<b>", [failed_entry("x", "<script>.yaml", "<img src=x>")])
    assert "<script>.yaml" not in page
    assert "&lt;img src=x&gt;" in page


TWO_ARMS = """<robot name="two">
  <link name="base"/><link name="l1"/><link name="l2"/><link name="left"/>
  <link name="r1"/><link name="r2"/><link name="right"/>
  {joints}
</robot>
"""
JOINT = """<joint name="{name}" type="continuous"><parent link="{parent}"/>
  <child link="{child}"/><origin xyz="{xyz}" rpy="{rpy}"/><axis xyz="0 0 1"/></joint>"""


def test_each_arm_of_a_robot_with_two_has_a_line(tmp_path: Path) -> None:
    """Two chains, two entries, and both are kept together."""
    joints = [
        ("a1", "base", "l1", "0 1 0", "0 0 0"),
        ("a2", "l1", "l2", "0 0 1", "1.5707963267948966 0 0"),
        ("a3", "l2", "left", "1 0 0", "0 0 0"),
        ("b1", "base", "r1", "0 -1 0", "0 0 0"),
        ("b2", "r1", "r2", "0 0 1", "1.5707963267948966 0 0"),
        ("b3", "r2", "right", "1 0 0", "0 0 0"),
    ]
    ends = "".join(
        f'<link name="{side}_tip"/><joint name="{side}_end" type="fixed"><parent '
        f'link="{side}"/><child link="{side}_tip"/><origin xyz="1 0 0"/></joint>'
        for side in ("left", "right")
    )
    keys = ("name", "parent", "child", "xyz", "rpy")
    text = "".join(JOINT.format(**dict(zip(keys, row, strict=True))) for row in joints)
    file = tmp_path / "two.urdf"
    file.write_text(TWO_ARMS.format(joints=text + ends))
    site = tmp_path / "site"
    first = build_site([str(file)], site, timeout=20)
    assert [entry.slug for entry in first.entries] == [
        "two--left-tip",
        "two--right-tip",
    ]
    assert {entry.verdict for entry in first.entries} == {"noncuspidal"}
    assert first.made == 1
    assert build_site([str(file)], site, timeout=20).made == 0
