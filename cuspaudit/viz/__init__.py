"""What a person looks at: the animated scene, the audit page, the figures."""

from cuspaudit.viz.page import render_page
from cuspaudit.viz.scene.motion import PathFrames, sample_path, sample_postures
from cuspaudit.viz.scene.scene import Scene, build_scene
from cuspaudit.viz.scene.shapes import LinkShape
from cuspaudit.viz.server import serve

__all__ = [
    "LinkShape",
    "PathFrames",
    "Scene",
    "build_scene",
    "render_page",
    "sample_path",
    "sample_postures",
    "serve",
]
